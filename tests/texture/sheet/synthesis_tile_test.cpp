#include "texture/sheet/synthesis_tile.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/parallel.h"
#include "tests/texture/sheet/sheet_samples.h"
#include "texture/quality/quality.h"
#include "texture/sheet/plan_data.h"

namespace belvedere {
namespace {

using namespace sheet_samples;

// Depths in which a near block is in front of far ground, across lines between tiles of 64 and 128.
GuideStack with_silhouettes(GuideStack stack) {
  stack.depth_m = Grid<float>(stack.width(), stack.height(), 5000.0F);
  for (int y = 90; y < 150 && y < stack.height(); ++y)
    for (int x = 50; x < 210 && x < stack.width(); ++x) stack.depth_m(x, y) = 2000.0F;
  return stack;
}

TEST(SynthesisTile, SameBitsInAnyOrderForAnyThreads) {
  const std::vector<Exemplar> exemplars{painting(150, 120, 1, 3), painting(60, 90, 9, 3)};
  const GuideStack target = with_silhouettes(land(201, 151, 40, 3));
  for (const int level : {1, 3}) {
    const SynthesisSheet sheet{201, 151, level, 128};
    MatchField reference;
    {
      const ThreadLimit one(1);
      SynthesisPlan plan = plan_of(exemplars, target, sheet);
      reference = all_tiles(plan, target);
    }
    const ThreadLimit two(2);
    SynthesisPlan plan = plan_of(exemplars, target, sheet);
    EXPECT_EQ(all_tiles(plan, target, true), reference) << "level " << level;
    EXPECT_EQ(tile_of(plan, target, sheet.tile(1, 0)), part_of(reference, sheet.tile(1, 0)))
        << "the plan is as it was";
  }
}

TEST(SynthesisTile, SameBitsForPatchesOfAnySizeAndAllSurroundings) {
  const std::vector<Exemplar> exemplars{painting(150, 120, 1, 2)};
  const GuideStack target = with_silhouettes(land(201, 151, 40, 2));
  for (const int side : {3, 11}) {
    SynthesisParameters parameters;
    parameters.neighbourhood = side;
    parameters.surroundings_of = "all";
    const SynthesisSheet sheet{201, 151, 1, 128};
    MatchField reference;
    {
      const ThreadLimit one(1);
      SynthesisPlan plan = plan_of(exemplars, target, sheet, parameters);
      reference = all_tiles(plan, target);
    }
    const ThreadLimit two(2);
    SynthesisPlan plan = plan_of(exemplars, target, sheet, parameters);
    EXPECT_EQ(all_tiles(plan, target, true), reference) << side << " × " << side;
    for (std::size_t i = 0; i < reference.size(); ++i)
      ASSERT_EQ(exemplars[0].guides.label(reference[i].x, reference[i].y), target.label[i]);
  }
}

// The strips along a line are made by both tiles; if they differed, pieces could not cross the line
// as they do elsewhere.
TEST(SynthesisTile, PiecesLieAcrossLinesAsInside) {
  const std::vector<Exemplar> exemplars{painting(200, 200, 1)};
  const GuideStack target = land(256, 256, 40);
  for (const int level : {1, 3}) {
    SynthesisPlan plan = plan_of(exemplars, target, {256, 256, level, 128});
    const MatchField field = all_tiles(plan, target);
    double pairs[2] = {0, 0};
    double joined[2] = {0, 0};
    for (int y = 0; y < 256; ++y) {
      for (int x = 1; x < 256; ++x) {
        for (const bool down : {false, true}) {
          const Match& here = down ? field(y, x) : field(x, y);
          const Match& before = down ? field(y, x - 1) : field(x - 1, y);
          const int across = x % 128 == 0 ? 1 : 0;
          ++pairs[across];
          joined[across] +=
              here.x - before.x == (down ? 0 : 1) && here.y - before.y == (down ? 1 : 0) ? 1 : 0;
        }
      }
    }
    const double inside = joined[0] / pairs[0];
    const double across = joined[1] / pairs[1];
    RecordProperty("coherence_across_percent_of_inside_" + std::to_string(level),
                   static_cast<int>(100 * across / inside));
    EXPECT_GT(inside, 0.5);
    EXPECT_GT(across, 0.85 * inside) << "level " << level;
  }
}

TEST(SynthesisTile, KeepsWhatSynthesisPromises) {
  std::vector<Exemplar> exemplars{painting(200, 180, 1, 3)};
  for (int x = 0; x < 40; ++x) exemplars[0].guides.label(x, 20) = unused_label;
  GuideStack target = with_silhouettes(land(220, 180, 40, 3));
  for (int x = 100; x < 180; ++x) target.label(x, 70) = unused_label;
  for (const int level : {1, 2, 3}) {
    SynthesisParameters parameters;
    parameters.copy_cap = 100;
    SynthesisPlan plan = plan_of(exemplars, target, {220, 180, level, 128}, parameters);
    const MatchField field = all_tiles(plan, target);
    for (int y = 0; y < 180; ++y) {
      for (int x = 0; x < 220; ++x) {
        const Match m = field(x, y);
        ASSERT_EQ(m.exemplar == Match::none, target.label(x, y) == unused_label) << x << ", " << y;
        if (m.exemplar != Match::none) {
          ASSERT_EQ(exemplars[0].guides.label(m.x, m.y), target.label(x, y)) << x << ", " << y;
        }
      }
    }
    const SynthesisQuality quality =
        measure_quality(field, exemplars, target, {"guide 0", 1.04F, 0});
    EXPECT_EQ(quality.across_silhouettes, 0.0) << "also where a line between tiles is";
    EXPECT_LE(quality.largest_piece, 100U) << "also across lines";
    EXPECT_LT(quality.guide_error_mean, 20.0);
  }
}

TEST(SynthesisTile, TilesOfOnePixelAndSheetsOfOddSides) {
  const std::vector<Exemplar> exemplars{
      painting(40, 50, 1)};  // on the plan's level under 16 texels high and wide
  for (const auto& [width, height] : {std::pair{129, 65}, std::pair{1, 130}, std::pair{67, 1},
                                      std::pair{1, 1}, std::pair{131, 193}}) {
    const GuideStack target = land(width, height, 40);
    for (const int level : {1, 2, 3}) {
      SynthesisPlan plan = plan_of(exemplars, target, {width, height, level, 64});
      const MatchField field = all_tiles(plan, target);
      for (std::size_t i = 0; i < field.size(); ++i)
        ASSERT_EQ(exemplars[0].guides.label(field[i].x, field[i].y), target.label[i]);
    }
  }
}

TEST(SynthesisTile, ReadsItsWindowAlone) {
  const std::vector<Exemplar> exemplars{painting(150, 120, 1)};
  const GuideStack target = land(400, 390, 40);
  const SynthesisSheet sheet{400, 390, 2, 128};
  SynthesisPlan plan = plan_of(exemplars, target, sheet);
  const PixelRect tile = sheet.tile(1, 1);
  const MatchField field = tile_of(plan, target, tile);
  const PixelRect window = synthesis_window(sheet, tile);
  GuideStack other = land(400, 390, 90);
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      other.label(x, y) = target.label(x, y);
      other.guides[0].values(x, y) = target.guides[0].values(x, y);
    }
  }
  EXPECT_EQ(tile_of(plan, other, tile), field);
  other.guides[0].values(tile.x0 + 5, tile.y0 + 5) ^= 64;
  EXPECT_NE(tile_of(plan, other, tile), field);
}

// The strips between tiles are made by the first tile and reused by the others, if made from the
// same guides.
TEST(SynthesisTile, WhatNeighboursHaveMadeIsTaken) {
  const std::vector<Exemplar> exemplars{painting(150, 120, 1)};
  const GuideStack target = land(400, 390, 40);
  const SynthesisSheet sheet{400, 390, 2, 128};
  SynthesisPlan fresh = plan_of(exemplars, target, sheet);
  const MatchField alone = tile_of(fresh, target, sheet.tile(2, 2));
  SynthesisPlan plan = plan_of(exemplars, target, sheet);
  tile_of(plan, target, sheet.tile(1, 1));
  EXPECT_EQ(plan.data().between_tiles.count(), 8U) << "four corners, four lines";
  tile_of(plan, target, sheet.tile(2, 1));
  EXPECT_EQ(plan.data().between_tiles.count(), 13U) << "two corners, three lines more";
  tile_of(plan, target, sheet.tile(1, 2));
  EXPECT_EQ(tile_of(plan, target, sheet.tile(2, 2)), alone);
  const std::size_t before = plan.data().between_tiles.count();
  const GuideStack other = land(400, 390, 90);
  EXPECT_EQ(tile_of(plan, other, sheet.tile(2, 2)), tile_of(fresh, other, sheet.tile(2, 2)));
  EXPECT_GT(plan.data().between_tiles.count(), before) << "other guides";
  GuideStack touched = target;
  const PixelRect tile = sheet.tile(2, 2);
  touched.guides[0].values(tile.x0, tile.y0) ^= 1;
  const std::size_t after = plan.data().between_tiles.count();
  tile_of(plan, touched, tile);
  EXPECT_GT(plan.data().between_tiles.count(), after) << "one value of one guide";
}

TEST(SynthesisTile, RefusesOtherTilesAndWindows) {
  const std::vector<Exemplar> exemplars{painting(60, 60, 1)};
  const GuideStack target = land(150, 140, 40);
  const SynthesisSheet sheet{150, 140, 1, 64};
  SynthesisPlan plan = plan_of(exemplars, target, sheet);
  const GuideStack window = window_of(target, synthesis_window(sheet, sheet.tile(0, 0)));
  EXPECT_NO_THROW(synthesize_tile(plan, window, sheet.tile(0, 0), silent_progress()));
  EXPECT_THROW(synthesize_tile(plan, window, sheet.tile(1, 0), silent_progress()), Error)
      << "the window of another";
  for (const PixelRect& tile : {PixelRect{0, 0, 63, 64}, PixelRect{2, 0, 66, 64},
                                PixelRect{-64, 0, 0, 64}, PixelRect{192, 0, 150, 64}})
    EXPECT_THROW(synthesize_tile(plan, window, tile, silent_progress()), Error) << tile.x0;
  GuideStack bare = window;
  bare.guides.clear();
  EXPECT_THROW(synthesize_tile(plan, bare, sheet.tile(0, 0), silent_progress()), Error);
}

TEST(SynthesisTile, TellsHowFarItIsAndStopsCleanly) {
  struct Stopping : Progress {
    void advance(double amount) override {
      done += amount;
      if (done > stop_at) throw Error(ErrorKind::interrupted, "test", "stopped");
    }
    double done = 0;
    double stop_at = 10;
  };
  const std::vector<Exemplar> exemplars{painting(100, 90, 1)};
  const GuideStack target = land(200, 190, 40);
  const SynthesisSheet sheet{200, 190, 2, 64};
  SynthesisPlan plan = plan_of(exemplars, target, sheet);
  const PixelRect tile = sheet.tile(1, 1);
  const GuideStack window = window_of(target, synthesis_window(sheet, tile));
  Stopping progress;
  const MatchField field = synthesize_tile(plan, window, tile, progress);
  EXPECT_NEAR(progress.done, 1.0, 1e-9);
  progress = {};
  progress.stop_at = 0.3;
  EXPECT_THROW(synthesize_tile(plan, window, tile, progress), Error);
  EXPECT_EQ(tile_of(plan, target, tile), field) << "no use was left counted";
}

}  // namespace
}  // namespace belvedere
