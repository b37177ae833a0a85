#include "terrain/layers/fit/ground_fit.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/layers/fit/held_out.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layers_file.h"
#include "tests/terrain/layers/fit/made_up_picture.h"

namespace belvedere {
namespace {

// Made-up ground whose seven classes lie by altitude and patches, and a picture of it.
KnownGround known_ground(int size = 160) {
  KnownGround ground;
  ground.cell_m = 30.0;
  ground.altitude_m = made_up::hills(size, size);
  made_up::Picture picture = made_up::seven_classes(ground.altitude_m, {140.0, 40.0}, 4.0);
  Grid<float> patches = made_up::hills(size, size, 77, 1.0);
  ground.input_names = {"altitude", "slope"};
  ground.inputs = {ground.altitude_m, patches};  // the second stands for whatever tells patches
  for (int k = 0; k != 7; ++k) ground.classes.push_back({"class " + std::to_string(k), std::nullopt, 0x808080});
  ground.labels = picture.classes;
  ground.picture = FitPicture{picture.rgb, 140.0};
  return ground;
}

TEST(FitGround, ReproducesColoursOfGroundNotSeen) {
  const KnownGround ground = known_ground();
  const HoldOut tiles = chessboard(160, 160, 16);
  const HeldOutResult fitted = judge_held_out(ground, {.model = LayerModel::additive}, tiles);
  const HeldOutResult bands = judge_bands(ground, tiles);
  EXPECT_GT(fitted.measures.accuracy, bands.measures.accuracy + 0.1);
  EXPECT_GT(fitted.measures.mean_auc, 0.9);
  ASSERT_EQ(fitted.differences.size(), 4U);
  EXPECT_LT(fitted.differences[2].mean, 4.0);  // of 32 × 32 cells
}

TEST(FitGround, FileEvaluatesToTheSharesOfTheFit) {
  const KnownGround ground = known_ground(96);
  for (const LayerModel model : {LayerModel::product, LayerModel::additive}) {
    const GroundFit fit = fit_ground(ground, {.model = model});
    const GroundPrediction prediction = predict_ground(ground, fit);
    const SurfaceLayers layers = parse_surface_layers(surface_layers_text(surface_layers_of(ground, fit, "test")), "test.toml");
    const LayerProgram program = compile_layers(layers);
    const PixelRect all{0, 0, 96, 96};
    const std::vector<Grid<float>> coverage = layer_coverage(program, ground.inputs, {}, all, 1);
    const Grid<glm::vec3> colour = layer_colour(program, coverage);
    double off = 0.0;
    for (std::size_t i = 0; i != colour.size(); ++i) off += std::abs(static_cast<double>(colour[i].x - prediction.even.r[i]));
    EXPECT_LT(off / static_cast<double>(colour.size()), 1.0)
        << "model " << static_cast<int>(model);  // samples between which files are linear
  }
}

TEST(FitGround, WhatIsNotLearnedFromDoesNotCount) {
  KnownGround ground = known_ground(96);
  Grid<std::uint8_t> learn(96, 96, 1);
  for (int y = 0; y != 96; ++y)
    for (int x = 48; x != 96; ++x) learn(x, y) = 0;
  const GroundFit before = fit_ground(ground, {}, &learn);
  for (int y = 0; y != 96; ++y)
    for (int x = 48; x != 96; ++x) {
      ground.labels[ground.altitude_m.index(x, y)] = 0;
      ground.picture->rgb.r(x, y) = 255.0F;
    }
  const GroundFit after = fit_ground(ground, {}, &learn);
  EXPECT_EQ(before.classes.bias, after.classes.bias);
  EXPECT_EQ(before.colours, after.colours);
  EXPECT_EQ(before.sun.elevation_deg, after.sun.elevation_deg);
}

TEST(FitGround, OneThreadOrTwoGiveTheSameFile) {
  const KnownGround ground = known_ground(96);
  const auto text = [&](int threads) {
    const ThreadLimit limit(threads);
    return surface_layers_text(surface_layers_of(ground, fit_ground(ground, {}), "test"));
  };
  EXPECT_EQ(text(1), text(2));
}

TEST(FitGround, TooLittleIsAnError) {
  KnownGround ground = known_ground(96);
  for (std::uint8_t& label : ground.labels) label = label == 3 ? 3 : no_class;
  EXPECT_THROW(fit_ground(ground, {}), Error);  // one class only
}

}  // namespace
}  // namespace belvedere
