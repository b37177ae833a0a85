#include "texture/statistical/choose_seed.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/noise.h"
#include "tests/texture/statistical/texture_crops.h"

namespace belvedere {
namespace {

// Paint drawn out along a direction.
Grid<Rgb8> drawn_crop(int side, double deg) {
  const double angle = deg * 3.14159265358979 / 180.0;
  Grid<Rgb8> out(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double along = x * std::cos(angle) + y * std::sin(angle);
      const double across = y * std::cos(angle) - x * std::sin(angle);
      const double v = gaussian_noise(4, along, across, 12.0, 1.0);
      out(x, y) = {test::level(120.0 + 40.0 * v), test::level(140.0 + 40.0 * v), test::level(90.0 + 20.0 * v)};
    }
  return out;
}

TEST(StrokeDirection, IsTheWayPaintIsDrawn) {
  for (const double deg : {0.0, 30.0, 90.0, 150.0}) {
    const StrokeDirection found = find_stroke_direction(drawn_crop(96, deg), {});
    const double off = std::remainder(found.deg - deg, 180.0);
    EXPECT_LT(std::abs(off), 4.0) << deg << " found as " << found.deg;
    EXPECT_LT(found.spread, .3F);
  }
  EXPECT_GT(find_stroke_direction(test::striped_crop(96, 96, 96), Grid<std::uint8_t>(96, 96, 0)).spread, .99F);  // nothing counts
}

TEST(ChooseSeed, TriesAllAndTakesTheNearest) {
  const Grid<Rgb8> crop = test::meadow_crop(80, 80);
  const LearnParameters quick{.types = 18, .levels = 1, .reach_px = 5, .coarse_reach = 3};
  CliqueModel model = learn_texture(crop, {}, quick).model;
  const std::vector<SeedTrial> trials = choose_seed(model, crop, {}, quick);
  EXPECT_EQ(trials.size(), 8U);
  for (std::size_t k = 1; k < trials.size(); ++k) EXPECT_GE(trials[k].score(), trials[k - 1].score());
  EXPECT_EQ(model.seed, trials.front().seed);
  EXPECT_EQ(model.seed_px, trials.front().px);
  EXPECT_EQ(model.polish, trials.front().polish);
}

// Dabs without a direction are not combed, whatever their Laplacian says.
TEST(ChooseSeed, StreaksAreForWhatIsDrawn) {
  const LearnParameters quick{.types = 18, .levels = 1, .reach_px = 5, .coarse_reach = 3};
  const auto chosen_for = [&](const Grid<Rgb8>& crop) {
    CliqueModel model = learn_texture(crop, {}, quick).model;
    return choose_seed(model, crop, {}, quick).front().seed;
  };
  const Grid<Rgb8> meadow = test::meadow_crop(96, 96);
  Grid<Rgb8> dabs(96, 96);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) dabs(x, y) = meadow(x / 3 * 3, y / 3 * 3);
  EXPECT_NE(chosen_for(dabs), TextureSeed::streaks);
}

}  // namespace
}  // namespace belvedere
