#include "terrain/layers/layer_coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/grid.h"
#include "base/random.h"
#include "terrain/layers/layer_noise.h"
#include "tests/grids.h"
#include "tests/terrain/layers/metres.h"

namespace belvedere {
namespace {

using test::metres;

SurfaceLayer layer(const std::string& name, int parent, std::uint32_t rgb, double bias = 1.0) {
  SurfaceLayer made;
  made.name = name;
  made.parent = parent;
  made.rgb = rgb;
  made.noise.bias = bias;
  return made;
}

std::vector<Grid<float>> coverage_of(const SurfaceLayers& layers,
                                     const std::vector<Grid<float>>& inputs, const PixelRect& cells,
                                     const GeoTransform& transform = metres,
                                     std::uint64_t seed = 7) {
  return layer_coverage(compile_layers(layers), inputs, transform, cells, seed);
}

// Smooth random functions of five inputs for twelve layers in three generations, with noise of four
// octaves.
SurfaceLayers twelve_layers(LayerModel model) {
  SurfaceLayers layers;
  layers.model = model;
  layers.inputs = {{"altitude", 0.0, 1.0},
                   {"slope", 0.0, 1.0},
                   {"north", 0.0, 1.0},
                   {"east", 0.0, 1.0},
                   {"flatness", 0.0, 1.0}};
  constexpr int parents[12] = {-1, 0, 1, 0, -1, 4, 4, -1, 7, 8, 8, -1};
  for (int k = 0; k < 12; ++k) {
    SurfaceLayer made = layer("layer " + std::to_string(k), parents[k],
                              static_cast<std::uint32_t>(random_bits(1, k, 0) & 0xffffffU), 0.9);
    made.noise.amplitude = 0.8;
    made.noise.scale_m = 300.0;
    for (int i = 0; i < 5; ++i) {
      LayerSamples samples;
      if (model == LayerModel::additive) {
        samples.at_0 = -4.0;
        samples.at_255 = 4.0;
      }
      const double phase = 6.0 * random_uniform(2, k, i);
      for (int s = 0; s < 256; ++s)
        samples.samples[static_cast<std::size_t>(s)] =
            static_cast<std::uint8_t>(std::lround(200.0 + 55.0 * std::sin(0.02 * s + phase)));
      made.functions.emplace_back(samples);
    }
    layers.layers.push_back(made);
  }
  return layers;
}

// Slow waves, so that a raster of another resolution has the same inputs.
std::vector<Grid<float>> waves(int count, const PixelRect& cells, const GeoTransform& transform) {
  std::vector<Grid<float>> inputs;
  for (int i = 0; i < count; ++i) {
    Grid<float>& grid = inputs.emplace_back(cells.width(), cells.height());
    for (const auto [x, y] : test::cells(grid)) {
      const glm::dvec2 at = transform.to_crs(cells.x0 + x, cells.y0 + y);
      grid(x, y) = static_cast<float>(
          0.5 + 0.5 * std::sin(at.x / (700.0 + 90.0 * i) + at.y / (900.0 - 70.0 * i) + i));
    }
  }
  return inputs;
}

// RGB' = (1 - C) RGB + C RGB_S, three layers of known coverage, by hand.
TEST(LayerCoverage, ThreeLayersInClosedForm) {
  SurfaceLayers layers;
  layers.ground_rgb = 0x646464;  // 100
  layers.layers = {layer("a", -1, 0xc80000, 0.5), layer("b", 0, 0x00c800, 0.5),
                   layer("c", -1, 0x0000c8, 0.25)};
  for (SurfaceLayer& l : layers.layers) l.functions.clear();
  const LayerProgram program = compile_layers(layers);
  const auto c = layer_coverage(program, {}, metres, {0, 0, 3, 2}, 1);
  EXPECT_EQ(c[0](2, 1), 0.5F);
  EXPECT_EQ(c[1](2, 1), 0.25F);  // half of the half that its parent covers
  EXPECT_EQ(c[2](2, 1), 0.25F);
  // Red: 100 → 150 → 112.5 → 84.375. Green: 100 → 50 → 87.5 → 65.625. Blue: 100 → 50 → 37.5
  // → 78.125.
  const glm::vec3 colour = layer_colour(program, c)(2, 1);
  EXPECT_EQ(colour, glm::vec3(84.375F, 65.625F, 78.125F));
  // Shares: c .25; b .25 · .75; a .5 · .75 · .75; the ground the rest.
  const auto shares = layer_shares(program, c);
  EXPECT_EQ(shares[3](0, 0), 0.25F);
  EXPECT_EQ(shares[2](0, 0), 0.1875F);
  EXPECT_EQ(shares[1](0, 0), 0.28125F);
  EXPECT_EQ(shares[0](0, 0), 0.28125F);
}

// Three rough layers by hand: b depends on the altitude that a raised, c on the slope and the
// altitude that both raised. Ground that falls by a tenth to the east.
TEST(LayerCoverage, HeightSlopeAndConditionsAreHandedOn) {
  SurfaceLayers layers;
  layers.name = "rough";
  layers.ground_rgb = 0x646464;
  layers.inputs = {{"altitude", 0.0, 1000.0}, {"slope", 0.0, 60.0}, {"east", -1.0, 1.0}};
  layers.layers = {layer("a", -1, 0xc80000, 0.5), layer("b", 0, 0x00c800),
                   layer("c", -1, 0x0000c8)};
  for (SurfaceLayer& l : layers.layers) l.functions.resize(3);
  layers.layers[0].roughness_m = 4.0;
  layers.layers[0].roughness_scale_m = 120.0;
  layers.layers[1].functions[0] = LayerHat{500.0, INFINITY, 20.0, 0.0};
  layers.layers[1].roughness_m = 6.0;
  layers.layers[1].roughness_scale_m = 90.0;
  layers.layers[2].functions[1] = LayerHat{5.0, INFINITY, 10.0, 0.0};
  layers.layers[2].functions[2] = LayerHat{0.7, INFINITY, 1.0, 0.0};
  layers.layers[2].when = "altitude > 498";
  layers.layers[2].roughness_m = 2.0;
  layers.layers[2].roughness_scale_m = 60.0;
  const LayerProgram program = compile_layers(layers);
  EXPECT_EQ(handed_on(program, 10.0), 2);
  EXPECT_EQ(handed_on(program, 100.0), 1);  // b's bumps are not visible in such cells
  constexpr int size = 40;
  const PixelRect cells{0, 0, size, size};
  constexpr double fall = 0.1;
  RaisedGround ground{Grid<float>(size, size), std::vector<Grid<float>>(3)};
  for (const auto [x, y] : test::cells(size, size))
    ground.height_m(x, y) = static_cast<float>(520.0 - 10.0 * fall * x);
  const double slope = std::atan(fall) * 180.0 / 3.14159265358979;
  ground.slope_north_east = {Grid<float>(size, size, static_cast<float>(slope)),
                             Grid<float>(size, size, 0.F),
                             Grid<float>(size, size, static_cast<float>(fall / (fall + 0.02)))};
  const Grid<float> before = ground.height_m;
  const std::vector<Grid<float>> inputs = {before, ground.slope_north_east[0],
                                           ground.slope_north_east[2]};
  const auto c = layer_coverage(program, inputs, metres, cells, 7, &ground);
  const auto bump = [&](std::size_t k, int x, int y) {
    return layer_noise_at(bump_noise(layers.layers[k].roughness_scale_m),
                          bump_seed(layers.layers[k], 7), metres.to_crs(x, y), 10.0)
        .value;
  };
  const auto above = [](double value, double low, double width) {
    return std::clamp((value - low) / width + 0.5, 0.0, 1.0);
  };
  const auto b_of = [&](int x, int y, double& height) {
    height = static_cast<double>(before(x, y)) + 0.5 * 4.0 * bump(0, x, y);
    const double covered = 0.5 * above(height, 500.0, 20.0);
    height += covered * 6.0 * bump(1, x, y);
    return covered;
  };
  const Grid<glm::vec3> colour = layer_colour(program, c);
  int partly = 0;
  for (const auto [x, y] : test::cells({1, 1, size - 1, size - 1})) {
    double height = 0.0;
    const double b = b_of(x, y, height);
    const auto height_at = [&](int at_x, int at_y) {
      double at = 0.0;
      b_of(at_x, at_y, at);
      return at;
    };
    const double east = (height_at(x + 1, y) - height_at(x - 1, y)) / 20.0;
    const double north = (height_at(x, y - 1) - height_at(x, y + 1)) / 20.0;
    const double steep = std::hypot(east, north);
    const double covered = height > 498.0 ? above(std::atan(steep) * 57.29577951308, 5.0, 10.0) *
                                                above(-east / (steep + 0.02), 0.7, 1.0)
                                          : 0.0;
    partly += covered > 0.05 && covered < 0.95 ? 1 : 0;
    if (std::abs(height - 498.0) < 0.01) continue;
    ASSERT_NEAR(c[0](x, y), 0.5, 1e-6);
    ASSERT_NEAR(c[1](x, y), b, 1e-4);
    ASSERT_NEAR(c[2](x, y), covered, 2e-3) << x << ' ' << y;
    ASSERT_NEAR(ground.height_m(x, y), height + covered * 2.0 * bump(2, x, y), 5e-3);
    // Red: 100 → 150 → less b's share of it → less c's.
    const double red = 150.0 * (1.0 - b) * (1.0 - covered);
    ASSERT_NEAR(colour(x, y).x, red, 0.5);
  }
  EXPECT_GT(partly, 200);
}

// Whatever bias and functions are, full and zero coverage stay; also for children. An expression of
// 0 is false.
TEST(LayerCoverage, StaysBetweenNothingAndAll) {
  SurfaceLayers layers;
  layers.layers = {layer("loud", -1, 0xc80000, 1.7), layer("child", 0, 0x00c800, 1.7),
                   layer("silent", -1, 0x0000c8, -0.3), layer("nowhere", -1, 0x0000c8, 1.0),
                   layer("everywhere", -1, 0x0000c8, 1.0)};
  layers.layers[3].when = "0";
  layers.layers[4].when = "0.001";
  const auto c = layer_coverage(compile_layers(layers), {}, metres, {0, 0, 3, 2}, 1);
  EXPECT_EQ(c[0](2, 1), 1.F);
  EXPECT_EQ(c[1](2, 1), 1.F);
  EXPECT_EQ(c[2](2, 1), 0.F);
  EXPECT_EQ(c[3](2, 1), 0.F);
  EXPECT_EQ(c[4](2, 1), 1.F);
}

// The hierarchy of the paper's figure 4: rock; grass with dark and dry grass; sand and a similar
// layer. Height and colour pass from each layer to the next, coverage only to children: a layer
// that fails its conditions changes nothing and hides its children.
TEST(LayerCoverage, CoverageGoesToChildrenAlone) {
  SurfaceLayers layers;
  layers.inputs = {{"altitude", 0.0, 1000.0}};
  const auto hat = [](double low, double high) {
    return std::vector<LayerFunction>{LayerHat{low, high, 0.0, 0.0}};
  };
  layers.layers = {layer("grass", -1, 0x00ff00, 0.8), layer("dark grass", 0, 0x008000, 0.5),
                   layer("dry grass", 1, 0x808000, 0.5), layer("light grass", 0, 0x80ff80, 0.25),
                   layer("sand", -1, 0xffff00, 1.0)};
  layers.layers[0].functions = hat(0.0, 600.0);
  layers.layers[1].functions = hat(0.0, 300.0);
  layers.layers[2].functions = hat(0.0, 1000.0);
  layers.layers[3].functions = hat(0.0, 1000.0);
  layers.layers[4].functions = hat(500.0, 1000.0);
  Grid<float> altitude(3, 1);
  altitude(0, 0) = 100.F;  // all but sand
  altitude(1, 0) = 400.F;  // no dark grass, hence no dry grass in it
  altitude(2, 0) = 800.F;  // no grass at all: sand on the bare ground
  const auto c = coverage_of(layers, {altitude}, {0, 0, 3, 1});
  EXPECT_FLOAT_EQ(c[0](0, 0), 0.8F);
  EXPECT_FLOAT_EQ(c[1](0, 0), 0.4F);
  EXPECT_FLOAT_EQ(c[2](0, 0), 0.2F);
  EXPECT_FLOAT_EQ(c[3](0, 0), 0.2F);  // of grass's .8, not of what dry grass left
  EXPECT_EQ(c[4](0, 0), 0.F);
  EXPECT_EQ(c[1](1, 0), 0.F);
  EXPECT_EQ(c[2](1, 0), 0.F);
  EXPECT_FLOAT_EQ(c[3](1, 0), 0.2F);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(c[k](2, 0), 0.F);
  EXPECT_EQ(c[4](2, 0), 1.F);
  EXPECT_EQ(layer_colour(compile_layers(layers), c)(2, 0), glm::vec3(255.F, 255.F, 0.F));
}

TEST(LayerCoverage, TablesAndHatsEqualTheirDefinition) {
  SurfaceLayers layers;
  layers.inputs = {{"altitude", -100.0, 3000.0}, {"slope", 0.0, 60.0}};
  SurfaceLayer made = layer("one", -1, 0);
  LayerSamples samples;
  for (int i = 0; i < 256; ++i)
    samples.samples[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(random_bits(4, i, 0));
  made.functions = {samples, LayerHat{10.0, 40.0, 5.0, 12.0}};
  layers.layers = {made};
  Grid<float> altitude(500, 1), slope(500, 1);
  for (int x = 0; x < 500; ++x) {
    altitude(x, 0) = static_cast<float>(-500.0 + 8.1 * x);
    slope(x, 0) = static_cast<float>(0.13 * x);
  }
  const auto c = coverage_of(layers, {altitude, slope}, {0, 0, 500, 1});
  // Sample i lies at -100 + 3100 (i + 1/2) / 256 m.
  const auto table = [&](double altitude_m) {
    const double at = std::clamp((altitude_m + 100.0) * 256.0 / 3100.0 - 0.5, 0.0, 255.0);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min<std::size_t>(below + 1, 255);
    const double part = at - static_cast<double>(below);
    return ((1.0 - part) * samples.samples[below] + part * samples.samples[above]) / 255.0;
  };
  // 0 up to 7.5°, 1 from 12.5° to 34°, 0 from 46°.
  const auto hat = [](double slope_deg) {
    if (slope_deg < 12.5) return std::max(0.0, (slope_deg - 7.5) / 5.0);
    return slope_deg <= 34.0 ? 1.0 : std::max(0.0, (46.0 - slope_deg) / 12.0);
  };
  for (int x = 0; x < 500; ++x)
    EXPECT_NEAR(c[0](x, 0), table(altitude(x, 0)) * hat(slope(x, 0)), 2e-5) << x;
}

TEST(LayerFunction, AHatHasTheValuesOfItsLines) {
  const LayerInput slope{"slope", 0.0, 60.0};
  const auto value = [&](const LayerHat& hat, double x) {
    return layer_function_value(hat, slope, LayerModel::product, x);
  };
  const LayerHat wide{10.0, 40.0, 5.0, 12.0};
  for (const auto& [x, expected] : {std::pair{7.0, 0.0},
                                    {7.5, 0.0},
                                    {9.0, 0.3},
                                    {10.0, 0.5},
                                    {12.0, 0.9},
                                    {12.5, 1.0},
                                    {25.0, 1.0},
                                    {34.0, 1.0},
                                    {37.0, 0.75},
                                    {40.0, 0.5},
                                    {43.0, 0.25},
                                    {46.0, 0.0}})
    EXPECT_NEAR(value(wide, x), expected, 1e-12) << x;
  // Sides that overlap: the smaller of both, 1/2 + (12 - x) / 10 against 1/2 + (x - 10) / 10.
  const LayerHat narrow{10.0, 12.0, 10.0, 10.0};
  for (const auto& [x, expected] : {std::pair{5.0, 0.0}, {8.0, 0.3}, {11.0, 0.6}, {14.0, 0.3}})
    EXPECT_NEAR(value(narrow, x), expected, 1e-12) << x;
  // Steps, which hold at the bounds.
  const LayerHat step{10.0, 12.0, 0.0, 0.0};
  for (const auto& [x, expected] : {std::pair{9.999, 0.0}, {10.0, 1.0}, {12.0, 1.0}, {12.001, 0.0}})
    EXPECT_EQ(value(step, x), expected) << x;
}

// Shares of an additive file are the softmax of siblings times the parent's, whatever the order of
// painting.
TEST(LayerCoverage, AdditiveSharesAreExact) {
  SurfaceLayers layers;
  layers.model = LayerModel::additive;
  layers.layers = {layer("rock", -1, 0x808080, std::log(1.0)),
                   layer("wood", -1, 0x008000, std::log(3.0)),
                   layer("spruce", 1, 0x004000, std::log(1.0)),
                   layer("beech", 1, 0x00a000, std::log(2.0)), layer("ice", -1, 0xffffff, 0.0)};
  const LayerProgram program = compile_layers(layers);
  const auto c = layer_coverage(program, {}, metres, {0, 0, 1, 1}, 1);
  const auto shares = layer_shares(program, c);
  EXPECT_NEAR(shares[0](0, 0), 0.0, 1e-6);
  EXPECT_NEAR(shares[1](0, 0), 0.2, 1e-6);
  EXPECT_EQ(shares[2](0, 0), 0.F);
  EXPECT_NEAR(shares[3](0, 0), 0.2, 1e-6);
  EXPECT_NEAR(shares[4](0, 0), 0.4, 1e-6);
  EXPECT_NEAR(shares[5](0, 0), 0.2, 1e-6);
  EXPECT_EQ(c[0](0, 0), 1.F);  // nothing lies under it
  EXPECT_NEAR(c[1](0, 0), 0.75, 1e-6);
}

TEST(LayerCoverage, NeverMoreThanTheParentAndSharesAreOne) {
  const PixelRect cells{0, 0, 200, 150};
  for (const LayerModel model : {LayerModel::product, LayerModel::additive}) {
    const SurfaceLayers layers = twelve_layers(model);
    const LayerProgram program = compile_layers(layers);
    const auto c = layer_coverage(program, waves(5, cells, metres), metres, cells, 3);
    const auto shares = layer_shares(program, c);
    double between = 0.0;  // that the test sees more than zeros and ones
    for (std::size_t i = 0; i < c[0].size(); ++i) {
      double sum = static_cast<double>(shares[0][i]);
      for (std::size_t k = 0; k < c.size(); ++k) {
        ASSERT_GE(c[k][i], 0.F);
        const int parent = layers.layers[k].parent;
        ASSERT_LE(c[k][i], parent < 0 ? 1.F : c[static_cast<std::size_t>(parent)][i]) << k;
        sum += static_cast<double>(shares[k + 1][i]);
        between += c[k][i] > 0.01F && c[k][i] < 0.99F ? 1.0 : 0.0;
      }
      ASSERT_NEAR(sum, 1.0, 1e-5);
    }
    EXPECT_GT(between / static_cast<double>(c[0].size()), 3.0);
  }
}

TEST(LayerCoverage, AnyRectangleHasTheBitsOfTheWhole) {
  SurfaceLayers layers = twelve_layers(LayerModel::product);
  layers.layers[4].when = "altitude > 0.3 + 0.2 * n210";
  const PixelRect whole{0, 0, 300, 200};
  const PixelRect part{37, 61, 251, 130};
  const auto inputs = waves(5, whole, metres);
  std::vector<Grid<float>> cut;
  for (const Grid<float>& grid : inputs) cut.push_back(part_of(grid, part));
  const auto c = coverage_of(layers, inputs, whole);
  const auto d = coverage_of(layers, cut, part);
  for (std::size_t k = 0; k < c.size(); ++k) ASSERT_EQ(part_of(c[k], part), d[k]) << k;
}

// Detail beyond the raster's resolution changes nothing on average: a cell of 20 m against 8 × 8
// cells of 2.5 m.
TEST(LayerCoverage, MeanColourDoesNotHangOnResolution) {
  for (const LayerModel model : {LayerModel::product, LayerModel::additive}) {
    const SurfaceLayers layers = twelve_layers(model);
    const LayerProgram program = compile_layers(layers);
    const GeoTransform coarse{600'000.0, 5'200'000.0, 20.0, 20.0};
    const GeoTransform fine{600'000.0, 5'200'000.0, 2.5, 2.5};
    const auto mean_of = [&](const GeoTransform& transform, int size) {
      const PixelRect cells{0, 0, size, size};
      const auto colour = layer_colour(
          program, layer_coverage(program, waves(5, cells, transform), transform, cells, 5));
      glm::dvec3 sum(0.0);
      for (const glm::vec3& c : colour) sum += glm::dvec3(c);
      return sum / static_cast<double>(colour.size());
    };
    const glm::dvec3 a = mean_of(coarse, 80);
    const glm::dvec3 b = mean_of(fine, 640);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(a[i], b[i], 0.1) << (model == LayerModel::product ? "product" : "additive");
  }
}

TEST(LayerCoverage, SaysHowMuchLiesOutsideItsRange) {
  SurfaceLayers layers;
  layers.inputs = {{"altitude", 100.0, 200.0}};
  Grid<float> altitude(4, 1);
  altitude(0, 0) = 50.F;
  altitude(1, 0) = 100.F;
  altitude(2, 0) = 200.F;
  altitude(3, 0) = 201.F;
  EXPECT_THAT(share_outside(compile_layers(layers), {altitude}), testing::ElementsAre(0.5));
}

}  // namespace
}  // namespace belvedere
