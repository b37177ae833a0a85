#include "texture/statistical/choose_seed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "tests/texture/statistical/texture_crops.h"

namespace belvedere {
namespace {

// Paint stretched along a direction, 12 pixels long; grain relative to its deviation.
Grid<Rgb8> drawn_crop(int side, double deg, double width_px, double grain) {
  const double angle = deg * 3.14159265358979 / 180.0;
  Grid<Rgb8> out(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double along = x * std::cos(angle) + y * std::sin(angle);
      const double across = y * std::cos(angle) - x * std::sin(angle);
      const double v =
          gaussian_noise(4, along, across, 12.0, width_px) + grain * random_uniform(6, x, y);
      out(x, y) = {test::level(120.0 + 40.0 * v), test::level(140.0 + 40.0 * v),
                   test::level(90.0 + 20.0 * v)};
    }
  return out;
}

TEST(StrokeDirection, IsTheWayPaintIsDrawn) {
  for (const double deg : {0.0, 30.0, 90.0, 150.0}) {
    const StrokeDirection found = find_stroke_direction(drawn_crop(96, deg, 1.0, 0.0), {});
    const double off = std::remainder(found.deg - deg, 180.0);
    EXPECT_LT(std::abs(off), 4.0) << deg << " found as " << found.deg;
    EXPECT_LT(found.spread, .3F);
  }
  EXPECT_GT(
      find_stroke_direction(test::striped_crop(96, 96, 96), Grid<std::uint8_t>(96, 96, 0)).spread,
      .99F);  // nothing counts
}

// The choice for a crop, and the trials.
struct Choice {
  CliqueModel model;
  std::vector<SeedTrial> trials;
};

Choice choose_for(const Grid<Rgb8>& crop) {
  const LearnParameters quick{.types = 18, .levels = 1, .reach_px = 5, .coarse_reach = 3};
  Choice choice{learn_texture(crop, {}, quick).model, {}};
  choice.trials = choose_seed(choice.model, crop, {}, quick);
  return choice;
}

// Soft round dabs: values of a lattice, each spread over its neighbourhood, with slight grain.
Grid<Rgb8> dabbed_crop(int size) {
  constexpr int spacing = 5;
  constexpr double reach = 2.2;  // of a value, squared, in spacings
  Grid<Rgb8> crop(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      double sum = 0.0;
      for (int j = -1; j <= 2; ++j)
        for (int i = -1; i <= 2; ++i) {
          const int column = x / spacing + i;
          const int row = y / spacing + j;
          const double dx = static_cast<double>(x) / spacing - column;
          const double dy = static_cast<double>(y) / spacing - row;
          const double left = 1.0 - (dx * dx + dy * dy) / reach;
          if (left > 0.0) sum += left * left * (random_uniform(5, column, row) - 0.5);
        }
      const double value = 120.0 + 150.0 * sum + 12.0 * (random_uniform(6, x, y) - 0.5);
      const auto byte = [value](double share) {
        return static_cast<std::uint8_t>(std::clamp(share * value, 0.0, 255.0));
      };
      crop(x, y) = {byte(0.9), byte(1.0), byte(0.6)};
    }
  return crop;
}

const Choice& choice_for_dabs() {
  static const Choice choice = choose_for(dabbed_crop(96));
  return choice;
}

TEST(ChooseSeed, TriesAllAndTakesTheNearest) {
  const CliqueModel& model = choice_for_dabs().model;
  const std::vector<SeedTrial>& trials = choice_for_dabs().trials;
  EXPECT_EQ(trials.size(), 6U);
  const auto min = [&](bool streaks, auto&& measure) {
    double out = 100.0;
    for (const SeedTrial& t : trials)
      if ((t.seed == TextureSeed::streaks) == streaks) out = std::min(out, measure(t));
    return out;
  };
  const auto shape = [](const SeedTrial& t) { return t.beyond + t.drawn; };
  EXPECT_GT(min(true, shape), streaks_margin * min(false, shape));
  const auto score = [](const SeedTrial& t) {
    return (t.beyond + t.drawn + t.turned) / (t.polish ? 1.0 : unpolished_margin);
  };
  EXPECT_EQ(score(trials.front()), min(false, score));
  EXPECT_EQ(model.seed, trials.front().seed);
  EXPECT_EQ(model.seed_px, trials.front().px);
  EXPECT_EQ(model.polish, trials.front().polish);
}

// By the figures beyond pairs alone streaks would be chosen: dabs without a direction would look
// combed.
TEST(ChooseSeed, StreaksAreForWhatIsMuchDrawn) {
  const CliqueModel& model = choice_for_dabs().model;
  const std::vector<SeedTrial>& trials = choice_for_dabs().trials;
  EXPECT_NE(model.seed, TextureSeed::streaks);
  const auto nearest =
      std::min_element(trials.begin(), trials.end(),
                       [](const SeedTrial& a, const SeedTrial& b) { return a.beyond < b.beyond; });
  EXPECT_EQ(nearest->seed, TextureSeed::streaks);
}

TEST(ChooseSeed, DrawnPaintBeginsWithStreaks) {
  EXPECT_EQ(choose_for(drawn_crop(96, 30.0, 3.0, .3)).model.seed, TextureSeed::streaks);
}

}  // namespace
}  // namespace belvedere
