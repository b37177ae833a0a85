#include "terrain/layers/fit/held_out.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace belvedere {
namespace {

// Two classes by altitude, which rises eastwards; a fifth of the labels is wrong.
KnownGround slope_ground() {
  KnownGround ground;
  ground.cell_m = 30.0;
  ground.altitude_m = Grid<float>(128, 128);
  for (int y = 0; y != 128; ++y)
    for (int x = 0; x != 128; ++x) {
      ground.altitude_m(x, y) = static_cast<float>(10.0 * x + 2.0 * random_normal(1, x, y));
      const bool high = ground.altitude_m(x, y) > 640.0F;
      ground.labels.push_back(high != (random_uniform(2, x, y) < 0.2) ? 1 : 0);
    }
  ground.input_names = {"altitude"};
  ground.inputs = {ground.altitude_m};
  ground.classes = {{"low", std::nullopt, 0x00ff00}, {"high", std::nullopt, 0x808080}};
  return ground;
}

TEST(HoldOuts, CoverAllInTwoParts) {
  EXPECT_EQ(chessboard(128, 128, 32).part(31, 31), 0);
  EXPECT_EQ(chessboard(128, 128, 32).part(32, 31), 1);
  EXPECT_EQ(chessboard(128, 128, 32).part(32, 32), 0);
  EXPECT_EQ(west_and_east(128, 128).part(64, 0), 1);
  EXPECT_EQ(north_and_south(128, 128).part(64, 63), 0);
}

TEST(JudgeHeldOut, IsAsGoodAsLabelsAllow) {
  const KnownGround ground = slope_ground();
  const HoldOut tiles = chessboard(128, 128, 16);
  EXPECT_NEAR(evaluate_held_out(ground, {.model = LayerModel::additive}, tiles).measures.accuracy,
              0.8, 0.02);
  EXPECT_NEAR(judge_bands(ground, tiles).measures.accuracy, 0.8, 0.03);
}

// Labels that depend on nothing: a fit evaluated on its own training cells would be better than
// chance.
TEST(JudgeHeldOut, NoiseIsNotLearned) {
  KnownGround ground = slope_ground();
  for (std::size_t i = 0; i != ground.labels.size(); ++i)
    ground.labels[i] = random_uniform(9, static_cast<std::int64_t>(i), 0) < 0.5 ? 1 : 0;
  EXPECT_NEAR(evaluate_held_out(ground, {.model = LayerModel::additive, .forest_share = 0.65},
                                chessboard(128, 128, 16))
                  .measures.mean_auc,
              0.5, 0.02);
}

}  // namespace
}  // namespace belvedere
