#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/random.h"
#include "terrain/generalize/generalize.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/generalize/mask.h"
#include "terrain/io/dem.h"
#include "terrain/synthetic/synthetic.h"
#include "tests/grids.h"
#include "tests/paths.h"
#include "tests/terrain/generalize/synthetic_relief.h"
#include "tests/terrain/shape/terrain_measures.h"

// Generalization against analytic results.
namespace belvedere {
namespace {

using test::alpine;
using test::cell_m;
using test::everywhere;
using test::grid_of;
using test::largest_difference;
using test::run;
using test::Weights;

// Frequency response of the kernel [.05 .25 .4 .25 .05].
double response(double omega) { return 0.4 + 0.5 * std::cos(omega) + 0.1 * std::cos(2.0 * omega); }

TEST(GeneralizeGain, OfACosineIsThatOfItsBandAlone) {
  // Reducing multiplies cos ωx by H(ω) and doubles ω, expanding multiplies by H again, so band i (0
  // the finest) holds Π_{j<i} H(2^j ω)² · (1 - H(2^i ω)²) of the wave. Aliases at other frequencies
  // are orthogonal to the wave over 256 cells if its number of waves is not a multiple of 8.
  constexpr int window = 256;
  for (const int waves : {3, 7, 13, 21, 45, 101}) {
    const double omega = 2.0 * std::numbers::pi * waves / window;
    for (const bool along_x : {true, false}) {
      const auto wave = [&](int x, int y) {
        return 100.0 * std::cos(omega * ((along_x ? x : y) - 128));
      };
      const Grid<float> terrain = grid_of(along_x ? 512 : 40, along_x ? 40 : 512, wave);
      double before = 1.0;  // what reaches the band
      for (std::size_t band = 0; band < 4; ++band) {
        const double h = response(std::ldexp(omega, static_cast<int>(band)));
        const double gain = before * (1.0 - h * h);
        before *= h * h;
        for (const float weight : {0.F, 2.5F}) {
          Weights weights(4, 1.F);
          weights[3 - band] = weight;
          const Grid<float> out = run(terrain, everywhere(weights));
          double sum = 0.0;
          for (int i = 128; i < 128 + window; ++i) {
            const int x = along_x ? i : 20;
            const int y = along_x ? 20 : i;
            sum += out(x, y) * wave(x, y);
          }
          EXPECT_NEAR(sum / (0.5 * window * 1e4), 1.0 + (weight - 1.0) * gain, 1e-5)
              << waves << " waves, band " << band << ", " << along_x;
        }
      }
    }
  }
}

TEST(GeneralizeEquationFive, MixesRidgeAndValleySetsAsWeights) {
  const Grid<float> terrain = alpine(160, 120);
  const GeneralizeParameters p{.foreground = {1.F, .75F, .5F, .25F},
                               .background = {.5F, .25F, .25F, 0.F},
                               .foreground_ridges = {0.F, .5F, .25F, 1.F},
                               .foreground_valleys = {.25F, 0.F, -.5F, .5F},
                               .background_ridges = {.5F, 1.F, 1.25F, 2.F},
                               .background_valleys = {.75F, .5F, .5F, -1.F}};
  // The same with one distance only: share · foreground + (1 - share) · background.
  const auto mixed = [&](float share) {
    const auto mix = [share](const Weights& near, const Weights& far) {
      Weights out = near;
      for (std::size_t i = 0; i < near.size(); ++i)
        out[i] = share * near[i] + (1.F - share) * far[i];
      return out;
    };
    return everywhere(mix(p.foreground, p.background),
                      mix(p.foreground_ridges, p.background_ridges),
                      mix(p.foreground_valleys, p.background_valleys));
  };
  GeneralizeGrids grids;
  for (const float share : {1.F, .75F, .5F, 0.F}) {
    grids.foreground_share = Grid<float>(160, 120, share);
    EXPECT_LE(largest_difference(run(terrain, p, grids), run(terrain, mixed(share))), 2e-3)
        << share;
  }
  // Each of the arrays has an effect.
  for (Weights GeneralizeParameters::*set :
       {&GeneralizeParameters::foreground_ridges, &GeneralizeParameters::background_ridges,
        &GeneralizeParameters::foreground_valleys, &GeneralizeParameters::background_valleys}) {
    GeneralizeParameters other = p;
    (other.*set)[3] += 1.F;
    grids.foreground_share = Grid<float>(160, 120, .5F);
    EXPECT_GT(largest_difference(run(terrain, p, grids), run(terrain, other, grids)), 1.0);
  }
}

// L_0 of 100 cos(2πx / 10), by the kernel: even and odd cells are expanded by different taps.
double finest_of_wave(int x) {
  const double omega = 2.0 * std::numbers::pi / 10.0;
  const double smooth = x % 2 == 0 ? 0.8 + 0.2 * std::cos(2.0 * omega) : std::cos(omega);
  return 100.0 * (1.0 - response(omega) * smooth) * std::cos(omega * x);
}

TEST(GeneralizeSides, OfAWaveAreWholeAndLeaveTheOtherSideBitForBit) {
  // Crests at x = 0, 10, …, troughs at 5, 15, …. Along x alone P = p² r has the sign of r, L_0's
  // second difference by the kernel, as has its mean.
  const Grid<float> terrain = grid_of(
      120, 48, [](int x, int) { return 100.0 * std::cos(2.0 * std::numbers::pi * x / 10.0); });
  GeneralizeParameters ridges = everywhere({1, 1, 1}, {0, 0, 3}, {0, 0, 0});
  GeneralizeParameters valleys = everywhere({1, 1, 1}, {0, 0, 0}, {0, 0, 3});
  ridges.exponent = valleys.exponent = 0.F;  // c = 1
  const Grid<float> r = run(terrain, ridges);
  const Grid<float> v = run(terrain, valleys);
  for (int x = 20; x < 100; ++x) {
    const double bend = finest_of_wave(x + 1) - 2.0 * finest_of_wave(x) + finest_of_wave(x - 1);
    EXPECT_NEAR((bend < 0.0 ? r : v)(x, 24) - terrain(x, 24), 3.0 * finest_of_wave(x), 2e-3) << x;
    EXPECT_EQ((bend < 0.0 ? v : r)(x, 24), terrain(x, 24)) << x;
  }
}

TEST(GeneralizeSides, OfAVeeAndARoof) {
  // Along the bottom of a V the band is level across: only its curvature shows that it is a valley.
  // The flanks of the dip in the band curve the other way, weakly.
  const Grid<float> vee =
      grid_of(129, 129, [](int x, int y) { return 1000.0 + 20.0 * std::abs(x - 64) + 5.0 * y; });
  const Grid<float> roof =
      grid_of(129, 129, [](int x, int y) { return 3000.0 - 20.0 * std::abs(x - 64) + 5.0 * y; });
  GeneralizeParameters ridges = everywhere({1, 1, 1, 1}, {0, 1, 1, 1}, {0, 0, 0, 0});
  GeneralizeParameters valleys = everywhere({1, 1, 1, 1}, {0, 0, 0, 0}, {0, 1, 1, 1});
  ridges.exponent = valleys.exponent = 0.F;
  const auto change = [](const Grid<float>& terrain, const GeneralizeParameters& p) {
    return std::abs(static_cast<double>(run(terrain, p)(64, 64)) - terrain(64, 64));
  };
  EXPECT_GT(change(vee, valleys), 5.0 * change(vee, ridges));
  EXPECT_GT(change(roof, ridges), 5.0 * change(roof, valleys));
  EXPECT_NEAR(change(roof, ridges), change(vee, valleys), 1e-2);
}

TEST(GeneralizeRecursion, TheFinestWeightsDoNotMoveTheFinestBreakLines) {
  // A' is linear in u_5 and v_5 with c_5 as it is: a step of u_5 adds L_5, a step of v_5 adds c_5
  // L_5, however large it is.
  const Grid<float> terrain = alpine(128, 128);
  const auto out = [&](float u, float v) {
    const Weights line = {0.F, .4F, .5F, .6F, v};
    return run(terrain, everywhere({1.F, .6F, .5F, .4F, u}, line, line));
  };
  const Grid<float> plain = out(0.F, .5F);
  const Grid<float> once = out(1.F, .5F);
  const Grid<float> often = out(5.F, .5F);
  const Grid<float> line = out(0.F, 1.5F);
  const Grid<float> line_often = out(5.F, 4.5F);
  double u_error = 0.0;
  double v_error = 0.0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    u_error = std::max(u_error, std::abs((static_cast<double>(often[i]) - plain[i]) -
                                         5.0 * (static_cast<double>(once[i]) - plain[i])));
    v_error = std::max(v_error, std::abs((static_cast<double>(line_often[i]) - often[i]) -
                                         4.0 * (static_cast<double>(line[i]) - plain[i])));
  }
  EXPECT_LE(u_error, 3e-3);
  EXPECT_LE(v_error, 3e-3);
  EXPECT_GT(largest_difference(line, plain), 1.0);
}

Grid<float> transposed(const Grid<float>& grid) {
  return grid_of(grid.height(), grid.width(), [&](int x, int y) { return grid(y, x); });
}

Grid<float> mirrored(const Grid<float>& grid) {
  return grid_of(grid.width(), grid.height(),
                 [&](int x, int y) { return grid(grid.width() - 1 - x, y); });
}

TEST(GeneralizeArtefacts, NeitherRowsNorColumnsAreFavoured) {
  // Turned and mirrored terrain gives turned and mirrored results. Mirrored sizes of 2^bands n + 1
  // keep their coarse cells.
  const Grid<float> terrain = alpine(193, 161);
  GeneralizeParameters p = find_generalize_preset("figure4")->bands;
  const Grid<float> out = run(terrain, p);
  // Sums in another order differ by 1e-4 m, and the weight of ridges changes within .02 of a form.
  EXPECT_LE(largest_difference(run(transposed(terrain), p), transposed(out)), 0.05);
  EXPECT_LE(largest_difference(run(mirrored(terrain), p), mirrored(out)), 0.05);
  // Noise without a direction stays isotropic: the energy of steps along rows and columns is equal.
  const Grid<float> noise =
      grid_of(257, 257, [](int x, int y) { return 1000.0 + 100.0 * random_uniform(5, x, y); });
  const Grid<float> smooth =
      run(noise, everywhere({1.F, .8F, .5F, .3F, .2F}, {0.F, .2F, .5F, .7F, .8F}));
  double rows = 0.0;
  double columns = 0.0;
  for (const auto [x, y] : test::cells({1, 1, 257, 257})) {
    rows += std::pow(static_cast<double>(smooth(x, y)) - smooth(x - 1, y), 2);
    columns += std::pow(static_cast<double>(smooth(x, y)) - smooth(x, y - 1), 2);
  }
  EXPECT_NEAR(rows / columns, 1.0, 0.02);
}

// Facets of the triangulated terrain outside lakes: level ones, and those that share their exact
// normal with another.
struct Facets {
  int level = 0;
  int repeated = 0;
  int all = 0;
};
Facets facets_of(const Grid<float>& z, const Grid<unsigned char>& lakes) {
  Facets facets;
  std::set<std::pair<float, float>> normals;
  const auto add = [&](float across, float down) {
    ++facets.all;
    if (across == 0.F && down == 0.F) ++facets.level;
    if (!normals.emplace(across, down).second) ++facets.repeated;
  };
  for (int y = 0; y + 1 < z.height(); ++y)
    for (int x = 0; x + 1 < z.width(); ++x) {
      if (lakes(x, y) != 0 || lakes(x + 1, y) != 0 || lakes(x, y + 1) != 0 ||
          lakes(x + 1, y + 1) != 0)
        continue;
      add(z(x + 1, y) - z(x, y), z(x, y + 1) - z(x, y));
      add(z(x + 1, y + 1) - z(x, y + 1), z(x + 1, y + 1) - z(x + 1, y));
    }
  return facets;
}

TEST(GeneralizeArtefacts, NoFlatTrianglesAndNoRepeatedNormalsArise) {
  SyntheticParameters made;
  made.width = made.height = 200;
  const Grid<float> terrain = make_synthetic_terrain(made, silent_progress()).altitude_m;
  // Lakes are level as they are: cells as high as the one beside them.
  Grid<unsigned char> lakes(200, 200);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const auto level_with = [&](int i, int j) {
        return terrain.contains(i, j) && terrain(i, j) == terrain(x, y);
      };
      lakes(x, y) = level_with(x + 1, y) || level_with(x - 1, y) || level_with(x, y + 1) ||
                    level_with(x, y - 1);
    }
  const Facets before = facets_of(terrain, lakes);
  ASSERT_GT(before.all, 58600);
  for (const std::string_view name : {"figure2", "figure4"}) {
    GeneralizeGrids grids;
    grids.keep = lakes;
    const Facets after = facets_of(run(terrain, find_generalize_preset(name)->bands, grids), lakes);
    EXPECT_LE(after.level, before.level) << name;
    // Altitudes are floats, so that a few normals coincide by chance.
    EXPECT_LE(after.repeated, before.repeated + before.all / 1000) << name << " of " << before.all;
  }
}

// What a run digs below existing hollows: the depth of each cell under its outlet, beyond its
// original depth.
double dug_m3(const Grid<float>& before, const Grid<float>& after) {
  const Grid<float> full_before = filled_hollows(before);
  const Grid<float> full_after = filled_hollows(after);
  double sum = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double was = static_cast<double>(full_before[i]) - before[i];
    const double is = static_cast<double>(full_after[i]) - after[i];
    sum += std::max(is - was, 0.0);
  }
  return sum * cell_m * cell_m;
}

TEST(RealGeneralize, AutomaticMaskDigsLessOnTerrainItWasNotMadeOn) {
  const std::string file = test::data_folder() + "/big_tujunga/bigtujunga.tif";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs " << file;
  DemParameters parameters;
  parameters.sources.emplace_back().path = file;
  const Grid<float> terrain = read_dem(parameters, silent_progress()).altitude_m;
  const GeneralizeParameters bands = find_generalize_preset("figure2")->bands;
  const double free = dug_m3(terrain, run(terrain, bands));
  GeneralizeGrids grids;
  grids.amplification_mask = slope_foot_mask(terrain, {cell_m, cell_m}, 32);
  const double masked = dug_m3(terrain, run(terrain, bands, grids));
  EXPECT_GT(free, 1e7);
  EXPECT_LT(masked, 0.6 * free) << masked << " of " << free;
}

}  // namespace
}  // namespace belvedere
