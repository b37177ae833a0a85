#include "texture/statistical/seed_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

// Correlation of a grid with itself shifted by (dx, dy).
double alike(const Grid<float>& v, int dx, int dy) {
  double mean = 0.0;
  for (const float one : v) mean += one / static_cast<double>(v.size());
  double both = 0.0;
  double own = 0.0;
  for (int y = 0; y + dy < v.height(); ++y)
    for (int x = 0; x + dx < v.width(); ++x) {
      both += (v(x, y) - mean) * (v(x + dx, y + dy) - mean);
      own += (v(x, y) - mean) * (v(x, y) - mean);
    }
  return both / own;
}

TEST(SeedNoise, WhiteIsEvenAndNeighboursAreStrangers) {
  const Grid<float> noise = seed_noise({}, {}, 128, 128, 0, 0);
  double mean = 0.0;
  for (const float v : noise) {
    EXPECT_GE(v, 0.F);
    EXPECT_LE(v, 1.F);
    mean += v / static_cast<double>(noise.size());
  }
  EXPECT_NEAR(mean, .5, .01);
  EXPECT_LT(std::abs(alike(noise, 1, 0)), .03);
  EXPECT_LT(std::abs(alike(noise, 0, 1)), .03);
}

TEST(SeedNoise, StreaksRunAlongTheField) {
  const SeedNoise level{TextureSeed::streaks, 8.F,
                        [](double, double) { return glm::vec2(1.F, 0.F); }, 1};
  const SeedNoise upright{TextureSeed::streaks, 8.F,
                          [](double, double) { return glm::vec2(0.F, 1.F); }, 1};
  EXPECT_GT(alike(seed_noise(level, {}, 96, 96, 0, 0), 4, 0), .6);
  EXPECT_LT(alike(seed_noise(level, {}, 96, 96, 0, 0), 0, 4), .1);
  EXPECT_GT(alike(seed_noise(upright, {}, 96, 96, 0, 0), 0, 4), .6);
}

TEST(SeedNoise, DiscsHaveOneValueWithin) {
  const Grid<float> noise = seed_noise({TextureSeed::discs, 8.F, {}, 1}, {}, 128, 128, 0, 0);
  EXPECT_GT(alike(noise, 2, 0), .5);
  EXPECT_LT(alike(noise, 16, 0), .15);
}

TEST(SeedNoise, WindowsOfOneTextureAgree) {
  for (const TextureSeed kind : {TextureSeed::white, TextureSeed::streaks, TextureSeed::discs})
    for (const int level : {0, 2}) {
      const SeedNoise noise{kind, 8.F, {}, 5};
      const Grid<float> whole = seed_noise(noise, {-64, -32}, 64, 64, level, 1);
      const Grid<float> part = seed_noise(noise, {0, 32}, 20, 20, level, 1);
      const int dx = 64 >> level;
      const int dy = 64 >> level;
      for (int y = 0; y < 20 && y + dy < 64; ++y)
        for (int x = 0; x < 20 && x + dx < 64; ++x) EXPECT_EQ(part(x, y), whole(x + dx, y + dy));
    }
}

TEST(OwnDirections, BendAsFarAsTheCropsSpread) {
  CliqueModel model;
  model.direction_deg = 30.F;
  const DirectionField straight = own_directions(model, 1);
  EXPECT_NEAR(straight(10.0, 500.0).y, .5F, 1e-6F);
  model.direction_spread = 1.F;
  const DirectionField bent = own_directions(model, 1);
  double max = 0.0;
  for (int k = 0; k < 50; ++k) {
    const glm::vec2 along = bent(97.0 * k, 31.0 * k);
    EXPECT_NEAR(along.x * along.x + along.y * along.y, 1.F, 1e-5F);
    max = std::max(max, static_cast<double>(std::abs(along.y - .5F)));
  }
  EXPECT_GT(max, .3);
}

}  // namespace
}  // namespace belvedere
