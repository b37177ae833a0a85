#include "renderer/rock/spurs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/rock/spur_peaks.h"
#include "tests/grids.h"
#include "tests/renderer/rock/rock_wall.h"

namespace belvedere {
namespace {

using test::limestone;

constexpr std::array<bool, spur_bands> second_band = {false, true, false, false};

// Spurs of a wall seen from afar, one pixel per unit.
struct Wall {
  explicit Wall(GuidanceBuffers g) : guidance(std::move(g)) {
    fall = smooth_fall_lines(wide, 1.0, {0, 0, guidance.width(), guidance.height()});
    field = grow_spurs({wide, fall, 1.0, 1}, limestone(),
                       {0, 0, guidance.width(), guidance.height()}, second_band);
  }
  SpurHits at(float x, float y) const {
    return find_spurs(field, 1, {x, y}, guidance.depth_m(static_cast<int>(x), static_cast<int>(y)));
  }
  GuidanceBuffers guidance;
  WideView wide{guidance, 1, {0, 0}};
  Grid<glm::vec2> fall;
  SpurField field;
};

// A field of one spur, at (50, 50), straight down the sheet.
SpurField lone_spur() {
  SpurField field;
  field.kind = &limestone();
  SpurCells& cells = field.bands[1][0];
  cells.spacing = 20.0F;
  cells.first = {2, 2};
  cells.count = {1, 1};
  Spur spur{.grown = true,
            .position = {50.0F, 50.0F},
            .top = 0.5F,
            .flank = {1.0F, 1.5F},
            .depth_m = 1000.0F};
  spur.tolerance_m = 100.0F;
  spur.id = 7;
  cells.spurs = {spur};
  cells.lanes = to_lanes(cells);
  return field;
}

TEST(Spurs, AreRoofsWithTwoFlatFlanks) {
  const SpurField field = lone_spur();
  const auto height = [&](float x, float y) {
    return find_spurs(field, 1, {x, y}, 1000.0F)[0].height;
  };
  EXPECT_FLOAT_EQ(height(50.0F, 50.0F), 0.5F);
  // Along the crest it hardly falls, and a flank falls by its steepness.
  EXPECT_NEAR(height(50.0F, 60.0F), 0.5F, 0.02F);
  const SpurHit right = find_spurs(field, 1, {55.0F, 60.0F}, 1000.0F)[0];
  const SpurHit left = find_spurs(field, 1, {45.0F, 60.0F}, 1000.0F)[0];
  EXPECT_EQ(right.side, 1);
  EXPECT_EQ(left.side, 0);
  EXPECT_NEAR(height(50.0F, 60.0F) - right.height, 0.25F * right.steepness, 0.01F);
  EXPECT_NEAR(right.steepness / left.steepness, 1.5F, 1e-4F);
  // Flat flanks: the slope is that of the heights, and the same at two positions.
  const float along_x = (height(56.0F, 60.0F) - height(54.0F, 60.0F)) / 2.0F * 20.0F;
  EXPECT_NEAR(right.slope.x, along_x, 0.03F);
  EXPECT_NEAR(height(57.0F, 60.0F) - height(55.0F, 60.0F),
              height(55.0F, 60.0F) - height(53.0F, 60.0F), 1e-4F);
}

TEST(Spurs, HoldOnToTheirOwnSurface) {
  const SpurField field = lone_spur();
  EXPECT_NE(find_spurs(field, 1, {50.0F, 50.0F}, 1050.0F)[0].spur, nullptr);
  EXPECT_EQ(find_spurs(field, 1, {50.0F, 50.0F}, 1100.0F)[0].spur, nullptr);
}

TEST(Spurs, OfThreeSizesStandOnEachOther) {
  const Wall wall(test::make_wall(260, 260, 1.0));
  int own = 0;
  int all = 0;
  double off_crest = 0.0;
  for (float y = 40.5F; y < 220.0F; y += 3.0F)
    for (float x = 40.5F; x < 220.0F; x += 3.0F) {
      const SpurHits hits = wall.at(x, y);
      for (const SpurHit& hit : hits.sizes) ASSERT_NE(hit.spur, nullptr);
      own += hits[1].spur->parent == hits[0].flank_id() ? 1 : 0;
      ++all;
      // Water runs off the crest of the larger one.
      off_crest -= hits[1].spur->down.x * hits[0].slope.x;
    }
  EXPECT_GT(own, all * 13 / 20);
  EXPECT_GT(off_crest / all, 0.1);
  // They have their spacing: as many as there are cells.
  EXPECT_NEAR(spur_spacing(limestone(), 0, 1) / spur_spacing(limestone(), 1, 1), 2.93F, 0.02F);
}

TEST(Spurs, EndAtRampsThatCrossAWall) {
  const Wall wall(test::make_wall(400, 400, 1.0));
  int ramps = 0;
  for (const Ramp& ramp : wall.field.ramps.ramps) {
    if (!ramp.cut) continue;
    ++ramps;
    EXPECT_GT(ramp.along.x, 0.5F) << "aslant, not upright";
    EXPECT_GT(std::abs(ramp.along.y), 0.3F) << "nor level";
  }
  EXPECT_GT(ramps, 5);
  // Few spurs are the same on both sides of an edge.
  int same = 0;
  int edges = 0;
  int same_elsewhere = 0;
  int elsewhere = 0;
  for (float y = 60.5F; y < 340.0F; y += 1.0F)
    for (float x = 60.5F; x < 340.0F; x += 1.0F) {
      const SpurHits here = wall.at(x, y);
      const SpurHits below = wall.at(x, y + 2.0F);
      const bool across = here.below_ramp < 0.0F && below.below_ramp > 0.0F &&
                          here.below_ramp > -2.5F && below.below_ramp < 2.5F;
      (across ? edges : elsewhere) += 1;
      (across ? same : same_elsewhere) += here[0].spur == below[0].spur ? 1 : 0;
    }
  ASSERT_GT(edges, 100);
  EXPECT_LT(static_cast<double>(same) / edges, 0.7 * same_elsewhere / elsewhere);
}

TEST(Spurs, AreSmallOnFarWalls) {
  EXPECT_EQ(spur_band(10.0F), 0);
  EXPECT_EQ(spur_band(44.0F), 1);
  EXPECT_EQ(spur_band(60.0F), 2);
  EXPECT_EQ(spur_band(500.0F), 3);
  for (int band = 1; band < spur_bands; ++band)
    EXPECT_LT(spur_spacing(limestone(), 0, band), spur_spacing(limestone(), 0, band - 1));
}

TEST(Spurs, NeverLeanMoreThanAWallFalls) {
  GuidanceBuffers g = test::make_wall(200, 200, 1.0);
  for (glm::vec2& fall : g.fall_line) fall = {1.0F, 0.0F};
  const Wall wall(std::move(g));
  EXPECT_NEAR(wall.fall(100, 100).y, 0.5F, 1e-5F);
  EXPECT_GT(wall.fall(100, 100).x, 0.8F);
  for (const Spur& spur : wall.field.bands[1][1].spurs) {
    if (!spur.grown) continue;
    EXPECT_GT(spur.down.y, 0.31F);
  }
}

TEST(Spurs, OfAPartAreThoseOfTheWhole) {
  const Wall wall(test::make_hills(1000, 1000, 1.0));
  const PixelRect part{490, 490, 510, 516};
  const PixelRect held = grown(part, static_cast<int>(std::ceil(spur_margin_units(limestone()))) +
                                         smooth_fall_reach(1.0, 1));
  ASSERT_GT(held.x0, 0);
  ASSERT_LT(held.x1, 1000);
  const GuidanceBuffers cut = test::cut(wall.guidance, held);
  const WideView wide{cut, 1, {held.x0, held.y0}};
  const Grid<glm::vec2> fall = smooth_fall_lines(wide, 1.0, {0, 0, cut.width(), cut.height()});
  const SpurField field = grow_spurs({wide, fall, 1.0, 1}, limestone(), part, second_band);
  for (const auto [x, y] : test::cells(part)) {
    const glm::vec2 position(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    const SpurHits own = find_spurs(field, 1, position, wall.guidance.depth_m(x, y));
    const SpurHits whole = wall.at(position.x, position.y);
    for (std::size_t k = 0; k < own.sizes.size(); ++k) {
      ASSERT_EQ(own[k].height, whole[k].height) << x << ' ' << y << " size " << k;
      ASSERT_EQ(own[k].flank_id(), whole[k].flank_id());
      ASSERT_EQ(own[k].slope, whole[k].slope);
    }
  }
}

}  // namespace
}  // namespace belvedere
