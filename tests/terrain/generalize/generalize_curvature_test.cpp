#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>

#include "base/filter.h"
#include "base/parallel.h"
#include "base/pyramid.h"
#include "base/random.h"
#include "terrain/generalize/generalize.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/generalize/mask.h"
#include "terrain/io/dem.h"
#include "terrain/shape/derivatives.h"
#include "tests/base/reconstruct.h"
#include "tests/grids.h"
#include "tests/paths.h"
#include "tests/terrain/generalize/synthetic_relief.h"
#include "tests/terrain/shape/terrain_measures.h"

namespace belvedere {
namespace {

using test::alpine;
using test::cell_m;
using test::everywhere;
using test::largest_difference;
using test::run;

GeneralizeGrids masked(Grid<float> mask) {
  GeneralizeGrids grids;
  grids.mask = std::move(mask);
  return grids;
}

TEST(GeneralizeCurvature, PyramidReconstructsHighRelief) {
  for (const auto& [width, height] :
       {std::pair{512, 512}, std::pair{513, 379}, std::pair{37, 61}}) {
    const Grid<float> terrain = alpine(width, height, 5000.0);
    EXPECT_LE(largest_difference(test::reconstruct(make_laplacian_pyramid(terrain, 6)), terrain),
              1e-3);
  }
}

TEST(GeneralizeCurvature, ExponentZeroAddsBothWeights) {
  for (const auto& [width, height] : {std::pair{140, 97}, std::pair{37, 61}}) {
    const Grid<float> terrain = alpine(width, height);
    GeneralizeParameters local = everywhere({1.F, .5F, .25F}, {.25F, .5F, .5F}, {.25F, .5F, .5F});
    local.exponent = 0.F;
    EXPECT_LE(largest_difference(run(terrain, local), run(terrain, everywhere({1.25F, 1.F, .75F}))),
              2e-3);
    local.exponent = 1.F;
    EXPECT_GT(largest_difference(run(terrain, local), run(terrain, everywhere({1.25F, 1.F, .75F}))),
              1.0);
  }
}

TEST(GeneralizeCurvature, CurvatureComesFromTheBandsBelow) {
  // The finest weights do not change where the second finest band finds its ridges: the coarser
  // level is identical.
  const Grid<float> terrain = alpine(128, 128);
  const Grid<float> a = run(terrain, everywhere({1.F, .3F, 1.F}, {0.F, .7F, 0.F}));
  const Grid<float> b = run(terrain, everywhere({1.F, .3F, 0.F}, {0.F, .7F, 0.F}));
  const Grid<float> finest = make_laplacian_pyramid(terrain, 1).bands[0];
  Grid<float> difference = a;
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] = a[i] - b[i] - finest[i];
  EXPECT_LE(largest_difference(difference, Grid<float>(128, 128)), 1e-3);
  // The lower weights do: a change of the coarsest moves the ridges of the next.
  const auto centre = [&](float coarsest) {
    Grid<float> out = run(terrain, everywhere({coarsest, .3F, 1.F}, {0.F, .7F, 0.F}));
    const Grid<float> plain = run(terrain, everywhere({coarsest, .3F, 1.F}));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] -= plain[i];
    return out;
  };
  EXPECT_GT(largest_difference(centre(1.F), centre(.2F)), 1.0);
}

TEST(GeneralizeCurvature, ValleySetLeavesConvexGroundAndRidgeSetConcaveGround) {
  // A fold of one wavelength along x, slightly tilted along y: its crest is at x = 24, its trough
  // at 72.
  Grid<float> fold(96, 64);
  for (const auto [x, y] : test::cells(96, 64))
    fold(x, y) = static_cast<float>(2000.0 + 60.0 * std::sin(x / 96.0 * 6.2831853) + 3.0 * y);
  GeneralizeParameters ridges =
      everywhere({1.F, 1.F, 1.F, 1.F}, {0.F, 1.F, 1.F, 1.F}, {0.F, 0.F, 0.F, 0.F});
  GeneralizeParameters valleys =
      everywhere({1.F, 1.F, 1.F, 1.F}, {0.F, 0.F, 0.F, 0.F}, {0.F, 1.F, 1.F, 1.F});
  ridges.exponent = valleys.exponent = 0.F;  // c = 1: only the choice of the set counts
  const auto change = [&](const Grid<float>& out, int x) {
    return std::abs(static_cast<double>(out(x, 32)) - fold(x, 32));
  };
  const Grid<float> r = run(fold, ridges);
  const Grid<float> v = run(fold, valleys);
  EXPECT_GT(change(r, 24), 3.0 * change(r, 72));
  EXPECT_GT(change(v, 72), 3.0 * change(v, 24));
}

TEST(GeneralizeCurvature, MaskZeroReturnsTheOriginalBitForBit) {
  Grid<float> terrain = alpine(101, 77);
  terrain(3, 3) = -0.F;
  GeneralizeParameters p = everywhere({2.F, .5F, 0.F}, {.5F, .5F, .5F});
  p.crest = 2.F;
  const Grid<float> out = run(terrain, p, masked(Grid<float>(101, 77, 0.F)));
  EXPECT_EQ(std::memcmp(out.data(), terrain.data(), terrain.size() * sizeof(float)), 0);
  EXPECT_EQ(run(terrain, p, masked(Grid<float>(101, 77, 1.F))), run(terrain, p));
}

// Coarse bands reach past the edge of a mask; its zeros keep their bits all the same.
TEST(GeneralizeCurvature, ZerosOfAMaskKeepTheirBits) {
  const Grid<float> terrain = alpine(257, 130);
  GeneralizeParameters p = everywhere({1.6F, 2.F, 1.5F, .5F, 0.F}, {0.F, .5F, .5F, .5F, .5F});
  p.crest = 1.F;
  p.base = 1.1F;
  Grid<float> hard(257, 130);
  for (int y = 0; y < 130; ++y) std::fill_n(hard.row(y), 128, 1.F);
  for (const Grid<float>& mask : {hard, soften_mask(hard)}) {
    const Grid<float> out = run(terrain, p, masked(mask));
    for (std::size_t i = 0; i < out.size(); ++i)
      if (mask[i] == 0.F) {
        ASSERT_EQ(out[i], terrain[i]) << i;
      }
    const Grid<float> all = run(terrain, p);
    for (int y = 0; y < 130; ++y) EXPECT_NEAR(out(10, y), all(10, y), 0.5) << y;
  }
}

TEST(GeneralizeCurvature, HalfMaskLeavesNoSeam) {
  // A crest along the mask's edge: there the change is large, and constant across the edge except
  // for a seam.
  const Grid<float> terrain = test::grid_of(256, 256, [&](int x, int y) {
    return 1500.0 + 200.0 * std::cos((x - 127.5) / 64.0 * 6.2831853) + 2.0 * y;
  });
  const GeneralizeParameters p = everywhere({1.8F, 2.F, 1.5F, 1.F, 1.F});
  Grid<float> half(256, 256);
  for (int y = 0; y < 256; ++y) std::fill_n(half.row(y), 128, 1.F);
  const Grid<float> out = run(terrain, p, masked(half));
  const Grid<float> all = run(terrain, p);
  double seam = 0.0;
  double naive = 0.0;
  for (int y = 0; y < 256; ++y) {
    // The step of the change from the last filtered to the first original column.
    seam += std::abs((static_cast<double>(out(127, y)) - terrain(127, y)) -
                     (static_cast<double>(out(128, y)) - terrain(128, y)));
    naive += std::abs(static_cast<double>(all(127, y)) - terrain(127, y));
  }
  EXPECT_LE(seam, 0.1 * naive);
}

TEST(GeneralizeCurvature, TheBaseScalesWhatIsLargerThanAllBands) {
  // Level ground has no bands.
  GeneralizeParameters p = everywhere({1.F, .5F, 2.F});
  p.base = 1.25F;
  for (const float v : run(Grid<float>(65, 40, 800.F), p)) ASSERT_NEAR(v, 1000.F, 1e-3F);
  // If base and bands have one weight, the ground is scaled as a whole.
  const Grid<float> terrain = alpine(150, 97);
  Grid<float> scaled = terrain;
  for (float& v : scaled) v *= 1.2F;
  p = everywhere({1.2F, 1.2F, 1.2F});
  p.base = 1.2F;
  EXPECT_LE(largest_difference(run(terrain, p), scaled), 2e-3);
  // By itself it adds (base - 1) G_1, whatever the bands are; 1 is the identity.
  Grid<float> lowest = reduce(reduce(reduce(terrain)));
  lowest = expand(lowest, reduce(reduce(terrain)).width(), reduce(reduce(terrain)).height());
  lowest = expand(lowest, 75, 49);
  lowest = expand(lowest, 150, 97);
  p = everywhere({1.F, 1.F, 1.F});
  p.base = 0.F;
  Grid<float> difference = run(terrain, p);
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] += lowest[i];
  EXPECT_LE(largest_difference(difference, terrain), 2e-3);
  p.base = 1.F;
  EXPECT_EQ(run(terrain, p), terrain);
  // A preview at half the size sees the same base, also where no band is left.
  for (const int skipped : {1, 3, 5}) {
    p.base = 1.5F;
    p.finest_band = skipped;
    for (const float v : run(Grid<float>(40, 40, 600.F), p)) ASSERT_NEAR(v, 900.F, 1e-3F);
  }
}

TEST(GeneralizeCurvature, BlurTakesSpikesOffBreakLines) {
  const Grid<float> terrain = alpine(256, 256);
  GeneralizeParameters p = everywhere({1.F, 1.F, .3F, .1F, 0.F}, {0.F, 0.F, .9F, 1.2F, 1.2F},
                                      {0.F, 0.F, .9F, 1.2F, 1.2F});
  const auto spikes = [&](double blur) {
    p.blur_cells = static_cast<float>(blur);
    const Grid<float> out = run(terrain, p);
    double sum = 0.0;  // fourth differences: what stands out from both neighbours
    for (const auto [x, y] : test::cells({2, 2, 254, 254})) {
      const double d = out(x - 2, y) - 4.0 * out(x - 1, y) + 6.0 * out(x, y) - 4.0 * out(x + 1, y) +
                       out(x + 2, y);
      sum += d * d;
    }
    return std::sqrt(sum);
  };
  EXPECT_LT(spikes(1.5), 0.8 * spikes(0.0));
}

TEST(GeneralizeCurvature, RidgesStaySharperThanUnderABlurOfEqualEnergy) {
  // A tilted roof: only its ridge is a break line.
  const Grid<float> roof = test::grid_of(129, 129, [&](int x, int y) {
    return 2000.0 - 18.0 * std::abs(x - 64) + 4.0 * y + 15.0 * random_uniform(3, x, y);
  });
  const Grid<float> out = run(roof, everywhere({1.F, .3F, 0.F, 0.F}, {0.F, .7F, 1.F, 1.F}));
  const auto rough = [](const Grid<float>& g) {  // energy of the detail on the slope
    double sum = 0.0;
    for (const auto [x, y] : test::cells({20, 20, 50, 110})) {
      const double d = g(x - 1, y) - 2.0 * g(x, y) + g(x + 1, y);
      sum += d * d;
    }
    return sum;
  };
  double low = 0.2;
  double high = 8.0;
  for (int i = 0; i < 20; ++i) {
    const double centre = 0.5 * (low + high);
    (rough(gaussian_blur(roof, centre)) > rough(out) ? low : high) = centre;
  }
  const Grid<float> blurred = gaussian_blur(roof, high);
  const auto bend = [](const Grid<float>& g) {
    double sum = 0.0;
    for (int y = 20; y < 110; ++y) sum += 2.0 * g(64, y) - g(63, y) - g(65, y);
    return sum;
  };
  EXPECT_GT(bend(out), 1.5 * bend(blurred));
}

TEST(GeneralizeCurvature, WhatThePrintCannotShowGoes) {
  const Grid<float> terrain = alpine(128, 128);
  GeneralizeParameters p = everywhere({1.F, 1.F, 1.F});
  GeneralizeGrids grids;
  grids.pixel_ground = {Grid<float>(128, 128, 1.F), 1};
  EXPECT_EQ(run(terrain, p, grids), terrain);
  // Wavelengths 120, 240, 480 m; at 110 m a pixel and 2.5 pixels the limit is 275 m: the finest is
  // gone, the coarsest whole.
  grids.pixel_ground = {Grid<float>(9, 9, 110.F), 16};
  const float t = 2.F * 240.F / 275.F - 1.F;
  EXPECT_LE(largest_difference(run(terrain, p, grids),
                               run(terrain, everywhere({1.F, t * t * (3.F - 2.F * t), 0.F}))),
            5e-3);
}

TEST(GeneralizeCurvature, SameBitsForAnyThreadCountAndAnySize) {
  for (const auto& size : {std::pair{301, 417}, std::pair{1, 40}, std::pair{40, 1}, std::pair{3, 3},
                           std::pair{1, 1}}) {
    const int width = size.first;  // clang 14 captures no structured bindings
    const int height = size.second;
    const Grid<float> terrain = alpine(width, height);
    GeneralizeParameters p = everywhere({1.2F, .5F, .25F}, {.25F, .5F, .5F}, {.1F, .2F, .3F});
    p.exponent = .6F;
    const auto with = [&](int threads) {
      const ThreadLimit limit(threads);
      return run(terrain, p, masked(Grid<float>(width, height, .7F)));
    };
    const Grid<float> one = with(1);
    EXPECT_EQ(one, with(2));
    for (const float v : one) ASSERT_TRUE(std::isfinite(v));
  }
}

TEST(GeneralizeCurvature, EveryPresetIsInRange) {
  for (const GeneralizePreset& preset : generalize_presets())
    EXPECT_NO_THROW(run(alpine(64, 64), preset.bands)) << preset.name;
}

TEST(Mask, SlopeMaskKeepsFlatGroundAndTheFootOfTheSlope) {
  // The slope begins at x = 20; two level columns at x = 50 are a ledge, not a flat.
  Grid<float> ground(80, 40);
  for (const auto [x, y] : test::cells(80, 40))
    ground(x, y) = 15.F * static_cast<float>(x < 20 ? 0 : x <= 50 ? x - 20 : x <= 52 ? 30 : x - 22);
  const Grid<float> mask = slope_mask(ground, {cell_m, cell_m}, {});
  EXPECT_LE(mask(5, 20), 1e-6F);
  EXPECT_LT(mask(21, 20), 0.15F);  // 26° steep as the next
  EXPECT_LT(mask(23, 20), 0.4F);
  EXPECT_GT(mask(29, 20), 0.9F);
  EXPECT_NEAR(mask(40, 20), 1.F, 1e-6F);
  EXPECT_GT(mask(54, 20), 0.95F);  // beside the ledge
  for (const float m : mask) ASSERT_TRUE(m >= 0.F && m <= 1.F);
}

TEST(RealGeneralize, AutomaticMaskDigsFewerPitsAtSlopeFeet) {
  const std::string file = test::data_folder() + "/lost_river/mackay.tif";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs " << file;
  DemParameters parameters;
  parameters.sources.emplace_back().path = file;
  const Dem dem = read_dem(parameters, silent_progress());
  const GeneralizeParameters bands = find_generalize_preset("figure2")->bands;
  GeneralizeGrids grids;
  const double free = pit_volume_m3(run(dem.altitude_m, bands), cell_m);
  grids.amplification_mask = slope_foot_mask(dem.altitude_m, {cell_m, cell_m}, 32);
  EXPECT_LT(pit_volume_m3(run(dem.altitude_m, bands, grids), cell_m), 0.4 * free);
}

}  // namespace
}  // namespace belvedere
