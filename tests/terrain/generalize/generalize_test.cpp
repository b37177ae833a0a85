#include "terrain/generalize/generalize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/pyramid.h"
#include "tests/base/reconstruct.h"
#include "tests/grids.h"
#include "tests/terrain/generalize/synthetic_relief.h"

namespace belvedere {
namespace {

using test::alpine;
using test::largest_difference;

// Equation 2 as written, by the pyramid; weights coarsest first.
Grid<float> equation_two(const Grid<float>& altitude_m, const std::vector<float>& weights) {
  LaplacianPyramid pyramid = make_laplacian_pyramid(altitude_m, static_cast<int>(weights.size()));
  for (std::size_t i = 0; i < pyramid.bands.size(); ++i)
    for (float& v : pyramid.bands[i]) v *= weights[weights.size() - 1 - i];
  return test::reconstruct(pyramid);
}

Grid<float> generalized(const Grid<float>& altitude_m, const GeneralizeParameters& parameters,
                        const Grid<float>& share = {}, const Grid<unsigned char>& keep = {}) {
  return belvedere::generalize(altitude_m, {30.0, 30.0},
                               {.foreground_share = share,
                                .keep = keep,
                                .mask = {},
                                .amplification_mask = {},
                                .pixel_ground = {}},
                               parameters, silent_progress());
}

TEST(Generalize, UnitWeightsReturnTheInputBitForBit) {
  Grid<float> terrain = alpine(101, 77);
  terrain(3, 3) = -0.F;  // below sea level and at it as well
  terrain(5, 5) = -430.5F;
  Grid<float> share(101, 77, 0.4F);
  Grid<unsigned char> keep(101, 77);
  keep(50, 50) = 1;
  const Grid<float> out = generalized(terrain, {}, share, keep);
  EXPECT_EQ(std::memcmp(out.data(), terrain.data(), terrain.size() * sizeof(float)), 0);
}

TEST(Generalize, EqualsEquationTwoForAnySize) {
  const std::vector<float> weights = {1.F, 1.F, 2.F, .25F, 0.F};  // figure 2 of the paper
  for (const auto& [width, height] : {std::pair{256, 256}, std::pair{133, 90}, std::pair{37, 61}}) {
    const Grid<float> terrain = alpine(width, height);
    EXPECT_LE(largest_difference(generalized(terrain, {weights, weights, 0.F}),
                                 equation_two(terrain, weights)),
              2e-3);
  }
}

TEST(Generalize, TheFirstWeightIsTheCoarsestBand) {
  // Single-cell noise lives in the finest band, the last weight.
  Grid<float> noise(128, 128);
  for (const auto [x, y] : test::cells(128, 128)) noise(x, y) = (x + y) % 2 == 0 ? 10.F : -10.F;
  const auto largest = [](const Grid<float>& g) {
    return *std::max_element(g.begin() + 64 * 60, g.begin() + 64 * 70);
  };
  EXPECT_NEAR(largest(generalized(noise, {{1, 1, 1, 0}, {1, 1, 1, 0}, 0.F})), 0.F, 0.5F);
  EXPECT_NEAR(largest(generalized(noise, {{0, 1, 1, 1}, {0, 1, 1, 1}, 0.F})), 10.F, 0.5F);
}

TEST(Generalize, SmallDemsGoWithoutTheCoarsestBands) {
  const Grid<float> terrain = alpine(6, 5);  // two bands at most
  const std::vector<float> weights = {9.F, 9.F, 9.F, 9.F, .5F, 0.F};
  EXPECT_LE(largest_difference(generalized(terrain, {weights, weights, 0.F}),
                               equation_two(terrain, {.5F, 0.F})),
            1e-3);
  EXPECT_EQ(generalized(Grid<float>(1, 1, 7.F), {weights, weights, 1.F})(0, 0), 7.F);
}

TEST(Generalize, ForegroundShareMixesTheWeights) {
  const Grid<float> terrain = alpine(160, 120);
  const std::vector<float> fore = {1.2F, 1.2F, 1.1F, 1.F};
  const std::vector<float> back = {1.5F, 1.F, .3F, 0.F};
  const std::vector<float> centre = {1.35F, 1.1F, .7F, .5F};
  const GeneralizeParameters parameters{fore, back, 0.F};
  const Grid<float> near = equation_two(terrain, fore);
  EXPECT_LE(largest_difference(generalized(terrain, parameters), near),
            2e-3);  // no share: all foreground
  EXPECT_LE(largest_difference(generalized(terrain, parameters, Grid<float>(160, 120, 1.F)), near),
            2e-3);
  EXPECT_LE(largest_difference(generalized(terrain, parameters, Grid<float>(160, 120, 0.F)),
                               equation_two(terrain, back)),
            2e-3);
  EXPECT_LE(largest_difference(generalized(terrain, parameters, Grid<float>(160, 120, .5F)),
                               equation_two(terrain, centre)),
            2e-3);
}

TEST(Generalize, ShareThatChangesAlongTheViewLeavesNoSeam) {
  const Grid<float> terrain = alpine(200, 200);
  const Grid<float> share =
      test::grid_of(200, 200, [&](int, int y) { return std::clamp((y - 60.F) / 80.F, 0.F, 1.F); });
  const GeneralizeParameters parameters{{1, 1, 1, 1, 1}, {1.5F, 1.F, .5F, .2F, 0.F}, 0.F};
  const Grid<float> out = generalized(terrain, parameters, share);
  const Grid<float> far = equation_two(terrain, parameters.background);
  double near_error = 0.0;
  double far_error = 0.0;
  for (int x = 0; x < 200; ++x) {
    near_error = std::max(near_error, std::abs(static_cast<double>(out(x, 199)) - terrain(x, 199)));
    far_error = std::max(far_error, std::abs(static_cast<double>(out(x, 2)) - far(x, 2)));
  }
  EXPECT_LE(near_error, 0.5);  // exact but for the coarsest bands' reach
  EXPECT_LE(far_error, 0.5);
}

TEST(Generalize, RampStaysARamp) {
  Grid<float> ramp(90, 70);
  for (const auto [x, y] : test::cells(90, 70))
    ramp(x, y) = 500.F + 10.F * static_cast<float>(x) + 4.F * static_cast<float>(y);
  EXPECT_LE(largest_difference(generalized(ramp, {{2, 0, 5, 0, 3}, {2, 0, 5, 0, 3}, 0.F}), ramp),
            1e-2);
}

// A lake of 40 × 30 cells at 800 m in steep country, whose bands are amplified.
struct LakeCase {
  Grid<float> terrain = alpine(160, 160);
  Grid<unsigned char> keep{160, 160};
  GeneralizeParameters parameters{{2.F, 2.F, 1.5F, .5F, 0.F}, {1, 1, 1, 1, 1}, .9F};
  LakeCase() {
    for (const auto [x, y] : test::cells({60, 60, 100, 90})) {
      terrain(x, y) = 800.F;
      keep(x, y) = 1;
    }
  }
};

TEST(Generalize, LakesKeepTheirLevelExactly) {
  const LakeCase c;
  const Grid<float> out = generalized(c.terrain, c.parameters, {}, c.keep);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (c.keep[i] != 0) {
      ASSERT_EQ(out[i], 800.F);
    }
}

TEST(Generalize, NoStepStandsAtTheShore) {
  const LakeCase c;
  const Grid<float> out = generalized(c.terrain, c.parameters, {}, c.keep);
  const Grid<float> free = generalized(c.terrain, c.parameters);
  // The step of the change D = A' - A from the last lake cell to the first shore cell, along the
  // whole shore.
  double step = 0.0;
  double naive_step = 0.0;
  for (int x = 60; x < 100; ++x) {
    for (const int y : {59, 90}) {
      step += std::abs(static_cast<double>(out(x, y)) - c.terrain(x, y));
      naive_step += std::abs(static_cast<double>(free(x, y)) -
                             c.terrain(x, y));  // keeping lake cells and nothing else
    }
  }
  EXPECT_LE(step, 0.1 * naive_step);
  // Far from the lake it has no effect.
  EXPECT_NEAR(out(3, 3), free(3, 3), 1.0);
}

TEST(Generalize, LakesAreNotLeftOnATable) {
  // A broad valley with a lake 12 cells wide on its level floor. Amplified coarse bands lower the
  // floor far; the lake stays, so the floor must come up to it, over many cells.
  Grid<float> valley(200, 200);
  Grid<unsigned char> keep(200, 200);
  for (const auto [x, y] : test::cells(200, 200)) {
    valley(x, y) =
        600.F + 800.F * std::clamp((static_cast<float>(std::abs(x - 100)) - 25.F) / 40.F, 0.F, 1.F);
    keep(x, y) = std::abs(x - 100) < 6 && std::abs(y - 100) < 20;
  }
  const GeneralizeParameters parameters{{2.F, 2.F, 1.5F, .5F, .5F, .5F}, {1, 1, 1, 1, 1, 1}, 0.F};
  const double sinking = 600.0 - generalized(valley, parameters)(100, 100);
  EXPECT_GT(sinking, 100.0);
  const Grid<float> out = generalized(valley, parameters, {}, keep);
  double steepest = 0.0;
  for (int i = 0; i < 60; ++i)
    steepest =
        std::max(steepest, std::abs(static_cast<double>(out(100, 119 + i)) - out(100, 120 + i)));
  EXPECT_LT(steepest, 0.055 * sinking);  // a cell; evenly over 32 cells it were .031
}

TEST(Generalize, CrestsRiseWhereTheyAreHighOnly) {
  // A roof-shaped crest 10 cells across on ground of a given altitude.
  const auto roof = [](float ground) {
    return test::grid_of(96, 96, [&](int x, int) {
      return ground + std::max(0.F, 200.F - 20.F * static_cast<float>(std::abs(x - 48)));
    });
  };
  GeneralizeParameters parameters;
  parameters.crest = .9F;
  const Grid<float> low = roof(600.F);
  EXPECT_EQ(generalized(low, parameters), low);
  const Grid<float> high = roof(2500.F);
  const Grid<float> sharp = generalized(high, parameters);
  EXPECT_GT(sharp(48, 48) - high(48, 48), 10.F);
  EXPECT_LE(sharp(48, 48) - high(48, 48), .9F * 60.F);
  EXPECT_NEAR(sharp(5, 48), high(5, 48), 0.5F);
  // In the distance it is a fifth less.
  const Grid<float> far = generalized(high, parameters, Grid<float>(96, 96, 0.F));
  EXPECT_NEAR(far(48, 48) - high(48, 48), .8F * (sharp(48, 48) - high(48, 48)), 1e-2F);
}

// The parts of a DEM that is larger than memory are generalized separately, at several cell sizes.
TEST(Generalize, AHalvedDemGetsWhatTheWholeGetsInItsBands) {
  const Grid<float> terrain = alpine(129, 111);
  GeneralizeParameters parameters;
  parameters.foreground = {1.3F, 0.6F, 1.2F, 0.7F, 1.F};  // the finest band is left as it is
  parameters.background = parameters.foreground;
  parameters.foreground_ridges = {0.F, 0.3F, 0.4F, 0.2F, 0.F};
  parameters.background_ridges = parameters.foreground_ridges;
  const Grid<float> whole = generalized(terrain, parameters);
  const Grid<float> half = reduce(terrain);
  parameters.finest_band = 1;
  Grid<float> change = generalize(half, {60.0, 60.0}, {}, parameters, silent_progress());
  for (std::size_t i = 0; i < change.size(); ++i) change[i] -= half[i];
  Grid<float> expected = expand(change, terrain.width(), terrain.height());
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] += terrain[i];
  EXPECT_LE(largest_difference(whole, expected), 2e-3);
  EXPECT_GT(largest_difference(whole, terrain), 5.0);
  // Halved so often that no band remains.
  parameters.finest_band = 5;
  EXPECT_EQ(generalize(half, {60.0, 60.0}, {}, parameters, silent_progress()), half);
}

// A halved DEM's crests are made of the bands it has.
TEST(Generalize, CrestEqualsItsFormula) {
  Grid<float> terrain = alpine(97, 110);
  for (float& v : terrain) v += 500.F;
  for (const int halved : {0, 1, 2, 3}) {
    const GeneralizeParameters parameters{.crest = 1.5F, .finest_band = halved};
    const Grid<float> out = generalized(terrain, parameters);
    // Bands 2, 3 and (by .6) 4 of what was perhaps halved, whose first ones are lost.
    LaplacianPyramid detail = make_laplacian_pyramid(terrain, 4 - halved);
    LaplacianPyramid ground = detail;
    for (std::size_t i = 0; i < detail.bands.size(); ++i) {
      const float weight = i + 1 == detail.bands.size() ? .6F : halved == 0 && i == 0 ? 0.F : 1.F;
      for (float& v : detail.bands[i]) v *= weight;
      std::fill(ground.bands[i].begin(), ground.bands[i].end(), 0.F);
    }
    std::fill(detail.base.begin(), detail.base.end(), 0.F);
    const Grid<float> fine = test::reconstruct(detail);
    const Grid<float> low = test::reconstruct(ground);
    Grid<float> expected = terrain;
    for (std::size_t i = 0; i < expected.size(); ++i)
      expected[i] +=
          1.5F * std::clamp((low[i] - 1200.F) / 700.F, 0.F, 1.F) * std::clamp(fine[i], 0.F, 60.F);
    EXPECT_LE(largest_difference(out, expected), 5e-3) << halved;
  }
}

TEST(Generalize, SaysWhatIsWrong) {
  EXPECT_THROW(generalized(Grid<float>(9, 9), {{1, 1}, {1}, 0.F}), Error);
  EXPECT_THROW(generalized(Grid<float>(9, 9), {}, Grid<float>(8, 9)), Error);
  EXPECT_THROW(generalized(Grid<float>(9, 9), {}, {}, Grid<unsigned char>(9, 8)), Error);
}

TEST(Generalize, SameBitsForAnyThreadCount) {
  const LakeCase c;
  Grid<float> share(160, 160);
  for (std::size_t i = 0; i < share.size(); ++i)
    share[i] = static_cast<float>(i) / static_cast<float>(share.size());
  const auto many = generalized(c.terrain, c.parameters, share, c.keep);
  const ThreadLimit one(1);
  EXPECT_EQ(generalized(c.terrain, c.parameters, share, c.keep), many);
}

}  // namespace
}  // namespace belvedere
