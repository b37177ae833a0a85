#include "terrain/layers/layer_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "terrain/layers/layer_picture.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

Grid<float> noise(const LayerNoise& of, const GeoTransform& transform, const PixelRect& cells,
                  std::uint64_t seed = 3) {
  LayerNoiseRows rows(of, seed, transform, cells);
  Grid<float> out(cells.width(), cells.height());
  for (int y = 0; y < cells.height(); ++y) rows.fill(cells.y0 + y, out.row(y));
  return out;
}

TEST(LayerNoise, IsBoundedCentredAndLoudEnough) {
  const Grid<float> n =
      noise({100.0, 4, 1.0, 0.0}, {600'000.0, 5'200'000.0, 5.0, 5.0}, {0, 0, 1000, 1000});
  double sum = 0.0, squares = 0.0;
  for (const float v : n) {
    ASSERT_LE(std::abs(v), 1.F);
    sum += static_cast<double>(v);
    squares += static_cast<double>(v * v);
  }
  const auto count = static_cast<double>(n.size());
  // 53² lattice values of standard deviation .577 in the coarsest octave, 2 / 1.875 of it: the
  // standard deviation of the mean is .012.
  EXPECT_NEAR(sum / count, 0.0, 0.04);
  EXPECT_NEAR(std::sqrt(squares / count), 0.33, 0.04);
}

// Rows in any order and rectangles of any size: lattice rows kept from one row to the next are
// those of the position.
TEST(LayerNoise, IsAFunctionOfThePlaceAlone) {
  const GeoTransform transform{-1234.5, 777.25, 7.0, 9.0};
  const LayerNoise of{50.0, 3, 1.0, 0.0};
  const Grid<float> whole = noise(of, transform, {0, 0, 120, 90});
  LayerNoiseRows rows(of, 3, transform, {11, 0, 97, 90});
  std::vector<float> line(86);
  for (const int y : {50, 3, 4, 5, 89, 88, 0, 40}) {
    rows.fill(y, line.data());
    for (int x = 0; x < 86; ++x)
      ASSERT_EQ(line[static_cast<std::size_t>(x)], whole(11 + x, y)) << x << ' ' << y;
  }
  // The same ground in a raster with another origin.
  const GeoTransform moved{transform.origin_x + 7.0 * 16.0, transform.origin_y - 9.0 * 8.0, 7.0,
                           9.0};
  const Grid<float> other = noise(of, moved, {0, 0, 40, 40});
  for (const auto [x, y] : test::cells(40, 40))
    ASSERT_NEAR(other(x, y), whole(x + 16, y + 8), 1e-5);
}

// The Gaussian field is that of base/random.h, octave by octave.
TEST(LayerNoise, GaussianRowsAreGaussianNoise) {
  const GeoTransform transform{600'000.0, 5'200'000.0, 10.0, 10.0};
  const PixelRect cells{5, 9, 80, 70};
  LayerNoiseRows rows({{5.0, 0.6, 11}, {40.0, 0.8, 12}}, transform, cells);
  std::vector<float> line(75);
  for (int y = 9; y < 70; ++y) {
    rows.fill(y, line.data());
    for (int x = 5; x < 80; ++x) {
      const glm::dvec2 at = transform.to_crs(x, y);
      ASSERT_NEAR(
          line[static_cast<std::size_t>(x - 5)],
          0.6 * gaussian_noise(11, at.x, at.y, 5.0) + 0.8 * gaussian_noise(12, at.x, at.y, 40.0),
          1e-5);
    }
  }
}

// Octaves shorter than a cell are left out: no random values at single positions.
TEST(LayerNoise, OctavesShorterThanACellAreLeftOut) {
  const GeoTransform coarse{0.0, 0.0, 60.0, 60.0};
  for (const float v : noise({60.0, 4, 1.0, 0.0}, coarse, {0, 0, 50, 50})) ASSERT_EQ(v, 0.F);
  const Grid<float> one = noise({120.0, 1, 1.0, 0.0}, coarse, {0, 0, 50, 50});
  const Grid<float> four = noise({120.0, 4, 1.0, 0.0}, coarse, {0, 0, 50, 50});
  EXPECT_GT(*std::max_element(one.begin(), one.end()), 0.3F);
  // The weight among all octaves is unchanged.
  for (std::size_t i = 0; i < one.size(); ++i)
    if (std::abs(one[i]) < 1.F) {
      ASSERT_NEAR(four[i], one[i] * (1.0 / 1.875), 1e-6);
    }
}

constexpr double cell_m = 20.0;

// A layer of stones on level ground at 400 m: uniform, or increasing to the east.
SurfaceLayers stones(double height_m, double length_m) {
  SurfaceLayers layers;
  layers.name = "stones";
  layers.inputs = {{"altitude", 0.0, 1000.0}};
  layers.layers.resize(1);
  layers.layers[0].name = "stones";
  layers.layers[0].roughness_m = height_m;
  layers.layers[0].roughness_scale_m = length_m;
  layers.layers[0].functions = {LayerHat{-1e6, 1e6, 0.0, 0.0}};
  return layers;
}

Dem level(int size) {
  Dem dem;
  dem.altitude_m = Grid<float>(size, size, 400.F);
  dem.filled = Grid<std::uint8_t>(size, size, 0);
  dem.transform = {1000.0, 5000.0, cell_m, cell_m};
  return dem;
}

GroundRelief relief_of(const SurfaceLayers& layers, const Dem& dem, std::uint64_t seed) {
  const SurfaceLayer& layer = layers.layers[0];
  return {dem.transform,
          {{layer.roughness_m, layer.roughness_scale_m, bump_seed(layer, seed),
            Grid<float>(dem.width(), dem.height(), 1.F)}},
          {}};
}

TEST(LayerRelief, NoiseAtAPlaceIsThatOfTheRaster) {
  const LayerNoise noise{90.0, 5, 1.0, 0.0};
  const GeoTransform fine{1000.0, 5000.0, 7.0, 7.0};
  LayerNoiseRows rows(noise, 5, fine, {10, 20, 60, 50});
  std::vector<float> row(50);
  for (int y = 20; y < 50; ++y) {
    rows.fill(y, row.data());
    for (int x = 10; x < 60; ++x) {
      const glm::dvec2 position = fine.to_crs(x, y);
      const NoiseAtPosition at = layer_noise_at(noise, 5, position, 7.0);
      ASSERT_NEAR(at.value, row[static_cast<std::size_t>(x - 10)], 1e-5) << x << ' ' << y;
      const auto value = [&](double east, double north) {
        return layer_noise_at(noise, 5, position + glm::dvec2(east, north), 7.0).value;
      };
      if (std::abs(at.value) > 0.99) continue;
      ASSERT_NEAR(at.slope.x, (value(0.01, 0.0) - value(-0.01, 0.0)) / 0.02, 1e-5);
      ASSERT_NEAR(at.slope.y, (value(0.0, 0.01) - value(0.0, -0.01)) / 0.02, 1e-5);
    }
  }
}

// The oracle is the picture from above: the slope of the ground that it raises cell by cell.
TEST(LayerRelief, SlopesAreThoseOfTheGroundAsThePictureFromAboveRaisesIt) {
  const Dem dem = level(24);
  const SurfaceLayers layers = stones(6.0, 80.0);
  constexpr int factor = 8;
  const LayerProgram program = compile_layers(layers);
  const LayerSurface surface = layer_surface(program, make_layer_ground(dem, {}, program.inputs),
                                             factor, {0, 0, 24 * factor, 24 * factor}, 3);
  const GroundRelief relief = relief_of(layers, dem, 3);
  const GeoTransform fine{1000.0, 5000.0, cell_m / factor, cell_m / factor};
  double square = 0.0;
  for (const auto [x, y] : test::cells({40, 40, 140, 140})) {
    const glm::dvec2 position = fine.to_crs(x, y);
    const glm::dvec2 slope = bump_slope(relief, position, cell_m / factor);
    const glm::vec3 normal = surface.normal(x, y);
    // Central differences over two cells of 2.5 m of bumps of which the shortest are 10 m long.
    ASSERT_NEAR(slope.x, -normal.x / normal.z, 0.015) << x << ' ' << y;
    ASSERT_NEAR(slope.y, -normal.y / normal.z, 0.015) << x << ' ' << y;
    square += glm::dot(slope, slope);
  }
  EXPECT_GT(std::sqrt(square / 1e4), 0.07) << "there are bumps";
}

TEST(LayerRelief, LevelGroundStaysLevelInTheMeanAndIsSmoothFromAfar) {
  const Dem dem = level(220);
  const SurfaceLayers layers = stones(4.0, 60.0);
  const GroundRelief relief = relief_of(layers, dem, 9);
  const auto look = [&](double pixel_m) {
    glm::dvec2 sum(0.0);
    double square = 0.0;
    int count = 0;
    for (double y = 1000.0; y < 4600.0; y += 13.0)
      for (double x = 1200.0; x < 5000.0; x += 13.0) {
        const glm::dvec2 slope = bump_slope(relief, {x, y}, pixel_m);
        sum += slope;
        square += glm::dot(slope, slope);
        ++count;
      }
    EXPECT_LT(glm::length(sum / static_cast<double>(count)), 0.004) << pixel_m;
    return std::sqrt(square / count);
  };
  double before = look(1.0);
  EXPECT_GT(before, 0.06);
  for (const double pixel_m : {10.0, 20.0, 40.0}) {
    const double now = look(pixel_m);
    EXPECT_LT(now, before) << pixel_m;
    before = now;
  }
  EXPECT_EQ(look(60.0), 0.0);
}

// Half as much cover, half as steep; where cover grows to the east its own slope counts: d(C N) = C
// dN + N dC.
TEST(LayerRelief, CoverageScalesAndTiltsTheBumps) {
  const Dem dem = level(40);
  const GroundRelief all = relief_of(stones(4.0, 60.0), dem, 2);
  GroundRelief half = all;
  for (float& share : half.bumps[0].share) share = 0.5F;
  GroundRelief growing = all;
  for (const auto [x, y] : test::cells(40, 40))
    growing.bumps[0].share(x, y) = static_cast<float>(x) / 40.F;
  const LayerNoise noise = bump_noise(60.0);
  for (double x = 1200.0; x < 1600.0; x += 17.0) {
    const glm::dvec2 position(x, 4630.0);
    const glm::dvec2 whole = bump_slope(all, position, 2.0);
    EXPECT_LT(glm::length(bump_slope(half, position, 2.0) - 0.5 * whole), 1e-6);
    const double cover = dem.transform.to_cell(position.x, position.y).x / 40.0;
    const double here = layer_noise_at(noise, all.bumps[0].seed, position, 2.0).value;
    const glm::dvec2 expected = cover * whole + glm::dvec2(4.0 * here / (40.0 * cell_m), 0.0);
    EXPECT_LT(glm::length(bump_slope(growing, position, 2.0) - expected), 1e-6) << x;
  }
  EXPECT_EQ(bump_slope({}, {1200.0, 4600.0}, 1.0), glm::dvec2(0.0));
}

TEST(LayerRelief, DepthsLieBetweenTheCells) {
  GroundRelief relief{level(4).transform, {}, Grid<float>(4, 4)};
  relief.lake_depth_m(1, 1) = 8.F;
  EXPECT_FLOAT_EQ(relief.depth_at(1000.0 + 1.5 * cell_m, 5000.0 - 1.5 * cell_m), 8.F);
  EXPECT_FLOAT_EQ(relief.depth_at(1000.0 + 2.0 * cell_m, 5000.0 - 1.5 * cell_m), 4.F);
  EXPECT_EQ(GroundRelief{}.depth_at(1.0, 2.0), 0.F);
}

// A round lake of 600 m radius in a bowl, and a pond too small to count.
Dem bowl() {
  Dem dem;
  dem.altitude_m = Grid<float>(200, 200);
  dem.filled = Grid<std::uint8_t>(200, 200, 0);
  dem.transform = {0.0, 0.0, 10.0, 10.0};
  for (const auto [x, y] : test::cells(200, 200)) {
    const double r = 10.0 * std::hypot(x - 100, y - 100);
    dem.altitude_m(x, y) = static_cast<float>(r <= 600.0 ? 500.0 : 500.0 + 0.2 * (r - 600.0));
  }
  return dem;
}

TEST(LakeBeds, AreBowlsDeepestInTheMiddle) {
  const Grid<float> depth = lake_depth_m(bowl());
  EXPECT_EQ(depth(20, 100), 0.F);
  EXPECT_EQ(depth(100, 30), 0.F);
  const float deepest = depth(100, 100);
  EXPECT_NEAR(deepest, 0.08 * 605.0, 2.0);  // half the shore's slope times the way to the shore
  // Half way to the shore: three quarters of the depth; the slope at the shore is .16.
  EXPECT_NEAR(depth(70, 100), 0.75 * deepest, 0.04 * deepest);
  EXPECT_NEAR(depth(43, 100) - depth(42, 100), 1.6, 0.2);
  for (int x = 41; x < 100; ++x) EXPECT_GE(depth(x + 1, 100), depth(x, 100)) << x;
}

TEST(LakeBeds, NoneIsDeeperThanAllowed) {
  LakeBedParameters parameters;
  parameters.deepest_m = 10.0;
  const Grid<float> depth = lake_depth_m(bowl(), parameters);
  EXPECT_NEAR(depth(100, 100), 10.0, 1e-4);
  EXPECT_NEAR(depth(70, 100), 7.5, 0.4);
}

}  // namespace
}  // namespace belvedere
