#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/pyramid.h"
#include "base/random.h"
#include "terrain/generalize/generalize.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/generalize/generalize_report.h"
#include "terrain/synthetic/synthetic.h"
#include "tests/grids.h"
#include "tests/terrain/generalize/synthetic_relief.h"
#include "tests/terrain/shape/terrain_measures.h"

// Properties for any terrain.
namespace belvedere {
namespace {

using test::everywhere;
using test::grid_of;
using test::largest_difference;
using test::run;

double ridges(int x, int y) {
  return 900.0 + 500.0 * std::abs(std::sin(x / 23.0)) +
         300.0 * std::abs(std::sin((x + 2 * y) / 17.0)) + 40.0 * random_uniform(8, x, y + 999);
}

TEST(GeneralizeProperties, ARampOfCentimetresSurvives) {
  const Grid<float> ramp = grid_of(120, 90, [](int x, int) { return 0.01 * x; });
  const Grid<float> out = run(ramp, everywhere({2.F, .5F, 0.F, 3.F}));
  for (const auto [x, y] : test::cells({1, 0, 120, 90}))
    ASSERT_NEAR(out(x, y) - out(x - 1, y), 0.01F, 1e-5F) << x << ' ' << y;
}

TEST(GeneralizeProperties, GlobalWeightsAreLinearInTerrainAndWeights) {
  const Grid<float> a = grid_of(97, 83, ridges);
  const Grid<float> b = grid_of(97, 83, [](int x, int y) { return ridges(y + 40, x); });
  const Grid<float> sum =
      grid_of(97, 83, [&](int x, int y) { return 0.5F * a(x, y) + 2.F * b(x, y); });
  const GeneralizeParameters p = everywhere({1.5F, .5F, 2.F, 0.F});
  const Grid<float> of_a = run(a, p);
  const Grid<float> of_b = run(b, p);
  EXPECT_LE(
      largest_difference(
          run(sum, p),
          grid_of(97, 83, [&](int x, int y) { return 0.5F * of_a(x, y) + 2.F * of_b(x, y); })),
      5e-3);
  const Grid<float> mean = run(a, everywhere({1.25F, .75F, 1.5F, .5F}));  // halfway between p and 1
  EXPECT_LE(largest_difference(
                mean, grid_of(97, 83, [&](int x, int y) { return 0.5F * (of_a(x, y) + a(x, y)); })),
            2e-3);
}

double energy(const Grid<float>& band, int y0, int y1) {
  double sum = 0.0;
  for (const auto [x, y] : test::cells({16, y0, band.width() - 16, y1}))
    sum += static_cast<double>(band(x, y)) * band(x, y);
  return sum;
}

TEST(GeneralizeProperties, FigureTwoTakesTheHighestBandAndRaisesTheMiddle) {
  const std::vector<float> weights = find_generalize_preset("figure2")->bands.foreground;
  const auto left = [&](const Grid<float>& terrain, std::size_t band) {
    const auto before = make_laplacian_pyramid(terrain, 5).bands;
    const auto after = make_laplacian_pyramid(run(terrain, everywhere(weights)), 5).bands;
    return energy(after[band], 2, after[band].height() - 2) /
           energy(before[band], 2, before[band].height() - 2);
  };
  // Kinks of the medium forms reach into the highest band, noise of single cells does not.
  const Grid<float> noise =
      grid_of(256, 256, [](int x, int y) { return 100.0 * random_uniform(5, x, y); });
  EXPECT_LT(left(noise, 0), 0.02);
  EXPECT_GT(left(grid_of(256, 256, ridges), 2),
            1.3);  // bands overlap, and its finer neighbour keeps a quarter
}

TEST(GeneralizeProperties, FigureFourIsQuietFarOffAndNotNear) {
  const Grid<float> terrain = grid_of(256, 256, ridges);
  GeneralizeGrids grids;  // near in the south
  grids.foreground_share =
      grid_of(256, 256, [](int, int y) { return std::clamp((y - 96) / 64.0, 0.0, 1.0); });
  const auto before = make_laplacian_pyramid(terrain, 2).bands;
  const auto after =
      make_laplacian_pyramid(run(terrain, find_generalize_preset("figure4")->bands, grids), 2)
          .bands;
  const auto left = [&](std::size_t band, int y0, int y1) {
    return energy(after[band], y0, y1) / energy(before[band], y0, y1);
  };
  EXPECT_LT(left(0, 8, 88), 0.6 * left(0, 168, 248));
  EXPECT_LT(left(1, 4, 44), 0.8 * left(1, 84, 124));
  EXPECT_GT(left(1, 84, 124), 0.8);
  // Only ridges remain: without their sets almost nothing is left in the distance.
  GeneralizeParameters plain = find_generalize_preset("figure4")->bands;
  plain.foreground_ridges = plain.background_ridges = {};
  const auto bare = make_laplacian_pyramid(run(terrain, plain, grids), 2).bands;
  EXPECT_LT(energy(bare[0], 8, 88), 0.25 * energy(after[0], 8, 88));
}

// Remaining factor of the highest band near the viewer: slightly reduced on slopes, raised along
// ridges.
TEST(GeneralizeProperties, FigureFourFirmsRidgesNear) {
  SyntheticParameters made;
  made.width = made.height = 256;
  made.cell_m = 30.0;
  const Grid<float> terrain = make_synthetic_terrain(made, silent_progress()).altitude_m;
  const Grid<float> before = make_laplacian_pyramid(terrain, 1).bands[0];
  const Grid<float> change = grid_of(
      256, 256, [&, after = run(terrain, find_generalize_preset("figure4")->bands)](int x, int y) {
        return static_cast<double>(after(x, y)) - terrain(x, y);
      });
  // Ridges are ground with a larger curvature than nineteen in twenty, slopes ground with less than
  // half of it.
  const Grid<float> bend = crest_curvature(terrain, {30.0, 30.0});
  std::vector<float> sorted(bend.begin(), bend.end());
  std::sort(sorted.begin(), sorted.end());
  const float ridge = sorted[sorted.size() * 19 / 20];
  const float slope = sorted[sorted.size() / 2];
  double on[2] = {0.0, 0.0};  // of slopes, of ridges: Σ change · band / Σ band²
  double of[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < terrain.size(); ++i) {
    if (bend[i] > slope && bend[i] < ridge) continue;
    const std::size_t side = bend[i] >= ridge ? 1 : 0;
    on[side] += static_cast<double>(change[i]) * before[i];
    of[side] += static_cast<double>(before[i]) * before[i];
  }
  EXPECT_GT(1.0 + on[1] / of[1], 1.35);
  EXPECT_LT(1.0 + on[0] / of[0], 0.9);
}

TEST(GeneralizeProperties, AHalfMaskIsHalfTheChange) {
  const Grid<float> terrain = grid_of(130, 110, ridges);
  GeneralizeGrids grids;
  grids.mask = Grid<float>(130, 110, .5F);
  EXPECT_LE(largest_difference(run(terrain, everywhere({2.F, .5F, 0.F}), grids),
                               run(terrain, everywhere({1.5F, .75F, .5F}))),
            2e-3);
  // In lakes and in the mask: both protect.
  grids.keep = Grid<unsigned char>(130, 110);
  for (int y = 40; y < 60; ++y)
    std::fill_n(grids.keep.row(y) + 40, 30, static_cast<unsigned char>(1));
  EXPECT_EQ(run(terrain, everywhere({2.F, .5F, 0.F}), grids)(50, 50), terrain(50, 50));
  GeneralizeGrids none = grids;
  std::fill(none.mask.begin(), none.mask.end(), 0.F);
  EXPECT_EQ(run(terrain, everywhere({2.F, .5F, 0.F}), none), terrain);
}

TEST(GeneralizeProperties, GroundOfAPixelIsLinearBetweenPosts) {
  const Grid<float> terrain = grid_of(130, 110, ridges);
  const auto metres = [](int x, int y) {
    return 60.0 + 1.5 * x + 0.5 * y;
  };  // through the fading of all bands
  GeneralizeGrids posts;
  posts.pixel_ground = {grid_of(10, 8, [&](int x, int y) { return metres(16 * x, 16 * y); }), 16};
  GeneralizeGrids cells;
  cells.pixel_ground = {grid_of(140, 120, metres), 1};
  const GeneralizeParameters p = everywhere({1.F, 1.F, 1.F});
  EXPECT_LE(largest_difference(run(terrain, p, posts), run(terrain, p, cells)), 2e-3);
  EXPECT_GT(largest_difference(run(terrain, p, posts), terrain), 5.0);
  // The last posts are extended.
  posts.pixel_ground.m_per_pixel = Grid<float>(2, 1, 150.F);
  cells.pixel_ground.m_per_pixel = Grid<float>(1, 1, 150.F);
  EXPECT_EQ(run(terrain, p, posts), run(terrain, p, cells));
}

TEST(GeneralizeProperties, LandAroundALakeDoesNotDependOnWhereTheLakeLies) {
  // The same ground 112 and 144 rows farther south: multiples of every band's cells and far from
  // the rim.
  const GeneralizeParameters p = everywhere({1.8F, 1.5F, .5F});
  const auto around = [&](int north) {
    const Grid<float> terrain =
        grid_of(96, 480, [north](int x, int y) { return ridges(x, y - north); });
    GeneralizeGrids grids;
    grids.keep = Grid<unsigned char>(96, 480);
    for (int y = north; y < north + 20; ++y)
      std::fill_n(grids.keep.row(y) + 30, 30, static_cast<unsigned char>(1));
    const Grid<float> out = run(terrain, p, grids);
    return grid_of(96, 140, [&](int x, int y) { return out(x, north - 60 + y); });
  };
  const Grid<float> here = around(120);
  EXPECT_LE(largest_difference(here, around(232)), 1e-3);  // just north of row 256, and south of it
  EXPECT_LE(largest_difference(here, around(264)), 1e-3);
}

}  // namespace
}  // namespace belvedere
