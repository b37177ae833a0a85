#include "terrain/layers/fit/ground_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layers_file.h"
#include "tests/terrain/layers/fit/synthetic_picture.h"

namespace belvedere {
namespace {

// Synthetic ground whose seven classes depend on altitude and patches, and a picture of it.
KnownGround known_ground(int size = 160) {
  KnownGround ground;
  ground.cell_m = 30.0;
  ground.altitude_m = synthetic::hills(size, size);
  synthetic::Picture picture = synthetic::seven_classes(ground.altitude_m, {140.0, 40.0}, 4.0);
  Grid<float> patches = synthetic::hills(size, size, 77, 1.0);
  ground.input_names = {"altitude", "slope"};
  ground.inputs = {ground.altitude_m, patches};  // the second stands for whatever tells patches
  for (int k = 0; k != 7; ++k)
    ground.classes.push_back({"class " + std::to_string(k), std::nullopt, 0x808080});
  ground.labels = picture.classes;
  ground.picture = FitPicture{picture.rgb, 140.0};
  return ground;
}

TEST(FitGround, ReproducesColoursOfGroundNotSeen) {
  const KnownGround ground = known_ground();
  const HoldOut tiles = chessboard(160, 160, 16);
  const HeldOutResult fitted = evaluate_held_out(ground, {.model = LayerModel::additive}, tiles);
  EXPECT_GT(fitted.measures.accuracy, judge_bands(ground, tiles).measures.accuracy + 0.1);
  EXPECT_GT(fitted.measures.mean_auc, 0.9);
  ASSERT_EQ(fitted.differences.size(), 4U);
  EXPECT_LT(fitted.differences[2].mean, 4.0);  // of 32 × 32 cells
}

// P13: a class that grows where each of the five inputs allows it. Fitted to every other column and
// measured on the rest, the error rises if any of the five is left out.
TEST(FitGround, EachOfTheFiveInputsLowersTheError) {
  constexpr int size = 96;
  KnownGround all;
  all.cell_m = 30.0;
  all.altitude_m = Grid<float>(size, size, 1000.0F);
  all.input_names = {"altitude", "slope", "temperature", "rain", "radiation"};
  all.inputs.assign(5, Grid<float>(size, size));
  all.classes = {{"meadow", LandCoverClass::pasture, 0x808080},
                 {"wood", LandCoverClass::forest, 0x808080}};
  Grid<std::uint8_t> learn(size, size, 0);
  std::vector<std::uint8_t> rest;
  for (int y = 0; y != size; ++y)
    for (int x = 0; x != size; ++x) {
      double grows = 1.0;
      for (int i = 0; i != 5; ++i) {
        const double value = random_normal(41, x, y, i);
        all.inputs[static_cast<std::size_t>(i)](x, y) = static_cast<float>(value);
        grows /= 1.0 + std::exp(-3.0 * (value + 1.0));
      }
      all.labels.push_back(random_uniform(42, x, y) < grows ? 1 : 0);
      learn(x, y) = x % 2 == 0 ? 1 : 0;
      rest.push_back(x % 2 == 0 ? no_class : all.labels.back());
    }
  const auto error = [&](const KnownGround& ground) {
    const GroundFit fit = fit_ground(ground, {}, &learn);
    return 1.0 - measure_classes(predict_ground(ground, fit).classes, rest).mean_auc;
  };
  const double with_all = error(all);
  EXPECT_LT(with_all, 0.17);
  for (std::size_t i = 0; i != 5; ++i) {
    KnownGround without = all;
    without.input_names.erase(without.input_names.begin() + static_cast<std::ptrdiff_t>(i));
    without.inputs.erase(without.inputs.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_GT(error(without), with_all + 0.01) << all.input_names[i];
  }
}

// The reported quality is that of the file, whatever the functions are.
TEST(FitGround, FileEvaluatesToWhatIsPredicted) {
  const KnownGround ground = known_ground(96);
  const std::vector<GroundFitParameters> ways = {{.model = LayerModel::product},
                                                 {.model = LayerModel::additive},
                                                 {.functions = FunctionSource::histogram}};
  for (const GroundFitParameters& way : ways) {
    const GroundFit fit = fit_ground(ground, way);
    const GroundPrediction prediction = predict_ground(ground, fit);
    const SurfaceLayers layers = parse_surface_layers(
        surface_layers_text(surface_layers_of(ground, fit, "test")), "test.toml");
    const LayerProgram program = compile_layers(layers);
    const std::vector<Grid<float>> coverage =
        layer_coverage(program, ground.inputs, {}, {0, 0, 96, 96}, 1);
    const Grid<glm::vec3> colour = layer_colour(program, coverage);
    float off = 0.0F;
    for (std::size_t i = 0; i != colour.size(); ++i)
      off = std::max(off, std::abs(colour[i].x - prediction.even[i].x));
    EXPECT_LT(off, 0.6F) << "colours of a file are whole numbers; way " << &way - ways.data();
    // Classes are the layers without a parent, each with those under it.
    std::vector<double> share(7, 0.0);
    const std::vector<Grid<float>> seen = layer_shares(program, coverage);
    for (std::size_t of = 0, k = 0; of != seen.size(); ++of) {
      if (of == 0 || layers.layers[of - 1].parent < 0)
        k = std::stoul(layers.layers[of == 0 ? 0 : of - 1].name.substr(6));
      for (const float s : seen[of])
        share[k] += static_cast<double>(s) / static_cast<double>(colour.size());
    }
    const std::vector<double> mean =
        mean_shares(prediction.classes, std::vector<std::uint8_t>(colour.size(), 0));
    for (std::size_t k = 0; k != 7; ++k) EXPECT_NEAR(share[k], mean[k], 1e-5) << k;
  }
}

// A class of false colour is shown in a given one, its children lighter and darker as they were.
TEST(FitGround, ClassesMayBeShownInAnotherColour) {
  KnownGround ground = known_ground(96);
  const GroundFit fit = fit_ground(ground, {});
  const SurfaceLayers before = surface_layers_of(ground, fit, "test");
  ground.classes[static_cast<std::size_t>(fit.classes.order[0])].shown =
      glm::vec3(100.F, 110.F, 150.F);
  const SurfaceLayers after = surface_layers_of(ground, fit, "test");
  const auto sum = [](std::uint32_t rgb) {
    return static_cast<int>((rgb >> 16U & 255U) + (rgb >> 8U & 255U) + (rgb & 255U));
  };
  for (std::size_t l = 0; l != after.layers.size(); ++l) {
    const bool first = l == 0 || after.layers[l].parent == 0;
    if (!first) {
      EXPECT_EQ(after.layers[l].rgb, before.layers[l].rgb);
      continue;
    }
    const auto blue = static_cast<int>(after.layers[l].rgb & 255U);
    EXPECT_NEAR(blue - static_cast<int>(after.layers[l].rgb >> 16U), 50, 1);
    EXPECT_NEAR(sum(after.layers[l].rgb) - sum(after.layers[0].rgb),
                sum(before.layers[l].rgb) - sum(before.layers[0].rgb), 4);
  }
}

// Including children, each class covers its own area of the training ground, in sunlight.
TEST(FitGround, ClassesCoverWhatTheyDid) {
  const KnownGround ground = known_ground(96);
  const GroundFit fit = fit_ground(ground, {});
  const Grid<float> light = sunlight(ground.altitude_m, ground.cell_m, fit.sun);
  std::vector<std::uint8_t> labels = ground.labels;
  for (std::size_t i = 0; i != labels.size(); ++i)
    if (!(light[i] > 0.05F)) labels[i] = no_class;
  const std::vector<double> mean = mean_shares(predict_ground(ground, fit).classes, labels);
  const std::vector<std::size_t> counts = count_labels(labels, 7);
  const double all =
      static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  for (std::size_t k = 0; k != 7; ++k)
    EXPECT_NEAR(mean[k], static_cast<double>(counts[k]) / all, 0.002) << k;
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
      ground.picture->rgb(x, y).x = 255.0F;
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
