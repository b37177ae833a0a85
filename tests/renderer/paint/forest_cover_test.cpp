#include "renderer/paint/forest_cover.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/paint/base_picture.h"
#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"
#include "tests/texture/strokes/stroke_picture.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// A wooded slope of 20 m per unit at 1700 m, with spruces only. `ppu` pixels per unit.
GuidanceBuffers wood(int width, int height, float ppu = 1.0F) {
  GuidanceBuffers g = test::make_slope(width, height, forest, {0.0F, 0.0F, 1.0F}, 28.0F);
  const float metres = 20.0F / ppu;
  for (const auto [x, y] : test::cells(width, height))
    g.position_m(x, y) = {metres * (static_cast<float>(x) + 0.5F),
                          -metres * (static_cast<float>(y) + 0.5F), 1700.0F};
  g.footprint_m = Grid<float>(width, height, metres);
  return g;
}

// Variance of the counts in square windows of 40 units (20 mm) divided by their mean: 1 for trees
// at random positions, near 0 for a lattice.
template <class Density>
double dispersion(Density&& density_of) {
  GuidanceBuffers g = wood(800, 600);
  BasePicture base =
      make_base_picture(g, read_palette("summer"), {}, {0, 0}, {800, 600}, silent_progress());
  density_of(base.tree_density);
  const StrokeParameters parameters;
  constexpr int cell = 40;
  Grid<int> counts(800 / cell, 600 / cell, 0);
  for (const Stroke& s : wood_strokes({g, base, parameters}))
    if (s.gate == StrokeGate::upright && s.alpha > 0.85F)  // bodies
      ++counts(std::clamp(static_cast<int>(s.points[0].x), 0, 799) / cell,
               std::clamp(static_cast<int>(s.points[0].y), 0, 599) / cell);
  double sum = 0.0;
  double squares = 0.0;
  for (const int n : counts) {
    sum += n;
    squares += static_cast<double>(n) * n;
  }
  const double mean = sum / static_cast<double>(counts.size());
  EXPECT_GT(mean, 30.0);
  return (squares / static_cast<double>(counts.size()) - mean * mean) / mean;
}

TEST(ForestCover, TreesStandInGroupsWithGaps) {
  const double even = dispersion([](Grid<float>& density) {
    for (float& d : density) d = 0.9F;
  });
  RecordProperty("dispersion_even", std::to_string(even));
  EXPECT_LT(even, 2.0) << "the measure itself: an even cover is no more uneven than chance";
  EXPECT_GT(dispersion([](Grid<float>&) {}), 3.6);
}

TEST(ForestCover, GladesAreBareAndFew) {
  const GuidanceBuffers g = wood(800, 600);
  const ForestCover cover = make_forest_cover(g, {g}, {}, {0, 0});
  int glades = 0;
  for (std::size_t i = 0; i < cover.glade.size(); ++i) {
    if (cover.glade[i] < 0.95F) continue;
    ++glades;
    EXPECT_LT(cover.density[i], glade_density);
  }
  const double share = static_cast<double>(glades) / static_cast<double>(cover.glade.size());
  EXPECT_GT(share, 0.02);
  EXPECT_LT(share, 0.15);
}

// Meadow above or below: the treeline is frayed, the lower edge forms a wall.
TEST(ForestCover, ThinsToTheTreelineNotToTheMeadow) {
  const auto density_at_edge = [](LandCoverClass beyond, bool above) {
    GuidanceBuffers g = wood(600, 160);
    for (const auto [x, y] : test::cells(600, 160))
      if (above ? y < 40 : y >= 120) g.land_cover(x, y) = beyond;
    const ForestCover cover = make_forest_cover(g, {g}, {}, {0, 0});
    double sum = 0.0;
    for (const auto [x, k] : test::cells(600, 8)) sum += cover.density(x, above ? 40 + k : 119 - k);
    return sum / 4800.0;
  };
  EXPECT_LT(density_at_edge(alpine_grass, true), 0.6 * density_at_edge(pasture, false));
  EXPECT_LT(density_at_edge(alpine_grass, true), 0.6 * density_at_edge(pasture, true));
  EXPECT_GT(density_at_edge(valley_floor, false), 0.6);
}

// Avalanches start at the treeline and run down the fall line, so bare areas there are longer than
// wide.
TEST(ForestCover, TracksRunDownTheFallLine) {
  GuidanceBuffers g = wood(600, 200);
  const glm::vec2 fall(0.6F, 0.8F);
  for (auto& d : g.fall_line) d = fall;
  for (const auto [x, y] : test::cells(600, 30)) g.land_cover(x, y) = rock;
  for (float& slope : g.slope_deg) slope = 40.0F;
  const ForestCover cover = make_forest_cover(g, {g}, {}, {0, 0});
  double along = 0.0;
  double across = 0.0;
  for (const auto [x, y] : test::cells({60, 32, 540, 60})) {
    along += std::abs(cover.glade(x + 6, y + 8) - cover.glade(x, y));
    across += std::abs(cover.glade(x - 8, y + 6) - cover.glade(x, y));
  }
  EXPECT_GT(across, 200.0) << "there are tracks";
  EXPECT_LT(along, 0.65 * across);
}

// Glades lie on shoulders and on the valley floor rather than in gullies and on steep slopes.
TEST(ForestCover, GladesFollowTheRelief) {
  const auto glades = [](float slope_deg, float relief_m, float valley_height_m) {
    GuidanceBuffers g = wood(800, 600);
    for (float& slope : g.slope_deg) slope = slope_deg;
    for (float& relief : g.relief_m_m) relief = relief_m;
    for (float& height : g.valley_height_m) height = valley_height_m;
    return test::mean(make_forest_cover(g, {g}, {}, {0, 0}).glade);
  };
  const double shoulder = glades(12.0F, 40.0F, 400.0F);
  const double gully = glades(28.0F, -40.0F, 400.0F);
  const double steep = glades(40.0F, 0.0F, 400.0F);
  const double floor = glades(6.0F, -20.0F, 20.0F);
  const double slope = glades(20.0F, 0.0F, 400.0F);
  EXPECT_GT(shoulder, 2.0 * slope);
  EXPECT_GT(floor, 1.2 * slope);
  EXPECT_LT(gully, slope);
  EXPECT_LT(steep, 0.8 * slope);
  EXPECT_LT(shoulder, 0.5) << "still a forest";
}

TEST(ForestCover, HollowsAreFullerThanRidges) {
  const auto mean_density = [](float relief_m) {
    GuidanceBuffers g = wood(300, 200);
    for (float& r : g.relief_s_m) r = relief_m;
    return test::mean(make_forest_cover(g, {g}, {}, {0, 0}).density);
  };
  EXPECT_GT(mean_density(-8.0F), mean_density(8.0F) + 0.08);
}

TEST(ForestCover, KeepsItsSizeOnTheSheet) {
  const GuidanceBuffers few = wood(200, 150);
  const GuidanceBuffers many = wood(800, 600, 4.0F);
  const ForestCover small = make_forest_cover(few, {few}, {}, {0, 0});
  const ForestCover large = make_forest_cover(many, {many}, {.pixels_per_unit = 4.0}, {0, 0});
  double difference = 0.0;
  for (const auto [x, y] : test::cells({10, 10, 190, 140}))
    difference +=
        std::abs(small.density(x, y) - large.density(4 * x + 2, 4 * y + 2)) / (180.0 * 130.0);
  EXPECT_LT(difference, 0.05);
}

TEST(ForestCover, OtherGroundHasNone) {
  GuidanceBuffers g = wood(40, 30);
  for (auto& id : g.land_cover) id = pasture;
  const ForestCover cover = make_forest_cover(g, {g}, {}, {0, 0});
  EXPECT_EQ(cover.density, Grid<float>(40, 30, 0.0F));
  EXPECT_EQ(cover.glade, Grid<float>(40, 30, 0.0F));
}

// A treeline above the part that is compared, out of reach of a small margin: tracks and thinning
// depend on it.
TEST(ForestCover, PartEqualsWhole) {
  GuidanceBuffers g = wood(360, 400);
  for (auto& d : g.fall_line) d = glm::vec2(0.28F, 0.96F);
  for (const auto [x, y] : test::cells(360, 150)) g.land_cover(x, y) = rock;
  for (float& slope : g.slope_deg) slope = 40.0F;
  const ForestCover whole = make_forest_cover(g, {g}, {}, {0, 0});
  const PixelRect kept{130, 165, 230, 240};
  const PixelRect part = test::with_margin(kept, forest_cover_margin_px(1.0), 360, 400);
  ASSERT_GT(part.x0, 0);
  ASSERT_GT(part.y0, 0);
  const GuidanceBuffers held = test::cut(g, part);
  const ForestCover cover =
      make_forest_cover(held, {held, 1, {part.x0, part.y0}}, {}, {part.x0, part.y0});
  for (const auto [x, y] : test::cells(kept)) {
    ASSERT_EQ(cover.density(x - part.x0, y - part.y0), whole.density(x, y));
    ASSERT_EQ(cover.glade(x - part.x0, y - part.y0), whole.glade(x, y));
  }
}

}  // namespace
}  // namespace belvedere
