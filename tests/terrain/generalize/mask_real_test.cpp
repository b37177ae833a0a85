#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "terrain/generalize/generalize.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/generalize/generalize_report.h"
#include "terrain/generalize/mask.h"
#include "tests/terrain/generalize/synthetic_relief.h"

// Properties of masks on real ground.
namespace belvedere {
namespace {

using test::cell_m;
using test::real_ground;
using test::run;

// The step of `out` from column x - 1 to x beyond the range between the original ground's step and
// the generalized ground's, so beyond the ground's own steps; the mean of all rows, m.
double step_at(const Grid<float>& out, const Grid<float>& original, const Grid<float>& all, int x) {
  double sum = 0.0;
  for (int y = 0; y < out.height(); ++y) {
    const auto step = [&](const Grid<float>& g) {
      return static_cast<double>(g(x, y)) - g(x - 1, y);
    };
    const double low = std::min(step(original), step(all));
    const double high = std::max(step(original), step(all));
    sum += std::max({0.0, low - step(out), step(out) - high});
  }
  return sum / out.height();
}

TEST(RealMask, AlongTheEdgeOfADrawnMaskNoPresetLeavesASeam) {
  for (const char* file : {"lost_river/mackay.tif", "big_tujunga/bigtujunga.tif"}) {
    const auto terrain = real_ground(file);
    if (!terrain) GTEST_SKIP() << "needs " << file;
    const int edge = terrain->width() / 2;
    GeneralizeGrids half;
    half.mask = Grid<float>(terrain->width(), terrain->height());
    for (int y = 0; y < terrain->height(); ++y) std::fill_n(half.mask.row(y), edge, 1.F);
    half.mask = soften_mask(half.mask);
    for (const GeneralizePreset& preset : generalize_presets()) {
      const Grid<float> all = run(*terrain, preset.bands);
      const Grid<float> out = run(*terrain, preset.bands, half);
      Grid<float> naive = *terrain;
      for (int y = 0; y < naive.height(); ++y) std::copy_n(all.row(y), edge, naive.row(y));
      double worst = 0.0;
      for (int x = edge - 16; x <= edge + 16; ++x)
        worst = std::max(worst, step_at(out, *terrain, all, x));
      EXPECT_LT(worst, 0.1 * step_at(naive, *terrain, all, edge)) << preset.name << ", " << file;
    }
  }
}

TEST(RealMask, MasksTakeHollowsOffTheFootOfSlopes) {
  struct Case {
    const char* file;
    double by_slope, by_feet;  // of the hollows dug without a mask, what is left at most
  };
  for (const Case& each :
       {Case{"lost_river/mackay.tif", 0.2, 0.01}, Case{"big_tujunga/bigtujunga.tif", 0.5, 0.01}}) {
    const auto terrain = real_ground(each.file);
    if (!terrain) GTEST_SKIP() << "needs " << each.file;
    const GeneralizeParameters bands = find_generalize_preset("figure2")->bands;
    const Grid<std::uint8_t> feet =
        slope_feet(*terrain, {cell_m, cell_m}, static_cast<int>(bands.foreground.size()));
    const auto hollows_m3 = [&](const Grid<float>& ground) {
      return find_pits(*terrain, ground, feet, {cell_m, cell_m}).at_feet_m3;
    };
    const double original = hollows_m3(*terrain);
    const double dug = hollows_m3(run(*terrain, bands)) - original;
    EXPECT_GT(dug, 1e6) << each.file;
    GeneralizeGrids slope;
    slope.mask = slope_mask(*terrain, {cell_m, cell_m}, {});
    EXPECT_LT(hollows_m3(run(*terrain, bands, slope)) - original, each.by_slope * dug) << each.file;
    GeneralizeGrids automatic;
    automatic.amplification_mask = slope_foot_mask(*terrain, {cell_m, cell_m}, 32);
    EXPECT_LT(hollows_m3(run(*terrain, bands, automatic)) - original, each.by_feet * dug)
        << each.file;
    // Steep ground is still generalized.
    double steep = 0.0;
    for (const float m : slope.mask) steep += m;
    EXPECT_GT(steep / static_cast<double>(slope.mask.size()), 0.55) << each.file;
  }
}

}  // namespace
}  // namespace belvedere
