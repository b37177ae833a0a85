#include "terrain/layers/layer_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/filter.h"
#include "base/grid_part.h"

namespace belvedere {
namespace {

Dem ground(int size, const std::function<double(double, double)>& altitude) {
  Dem dem;
  dem.altitude_m = Grid<float>(size, size);
  dem.filled = Grid<std::uint8_t>(size, size, 0);
  dem.transform = {1000.0, 5000.0, 10.0, 10.0};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      dem.altitude_m(x, y) = static_cast<float>(altitude(10.0 * x, -10.0 * y));
  return dem;
}

SurfaceLayers rough_layers(double roughness_m) {
  SurfaceLayers layers;
  layers.inputs = {{"altitude", 0.0, 1000.0}, {"slope", 0.0, 60.0}};
  layers.layers.resize(2);
  layers.layers[0].name = "a";
  layers.layers[0].roughness_m = roughness_m;
  layers.layers[0].noise = {40.0, 3, 0.5, 0.6};
  layers.layers[0].functions = {LayerHat{0.0, 500.0, 1.0, 50.0}, {}};
  layers.layers[1].name = "b";
  layers.layers[1].rgb = 0xffffff;
  layers.layers[1].functions = {LayerHat{495.0, 505.0, 0.0, 0.0}, {}};
  return layers;
}

LayerSurface whole_surface(const SurfaceLayers& layers, const Dem& dem, int factor) {
  const LayerProgram program = compile_layers(layers);
  return layer_surface(program, make_layer_ground(dem, {}, program.inputs), factor,
                       {0, 0, dem.width() * factor, dem.height() * factor}, 3);
}

// The spline passes through its cells and reproduces straight slopes; without the prefilter peaks
// would be lower by a third.
TEST(LayerSurface, SplinePassesThroughTheCells) {
  Grid<float> spike(41, 41);
  spike(20, 20) = 100.F;
  const Grid<float> coefficients = spline_coefficients(spike);
  EXPECT_NEAR(sample_bspline(coefficients, 20.0, 20.0), 100.0, 1e-3);
  EXPECT_NEAR(sample_bspline(coefficients, 21.0, 20.0), 0.0, 1e-3);
  EXPECT_NEAR(sample_bspline(coefficients, 25.0, 17.0), 0.0, 1e-3);
  EXPECT_NEAR(sample_bspline(spike, 20.0, 20.0), 44.4, 0.1);
  const Dem plane = ground(60, [](double x, double y) { return 300.0 + 0.2 * x + 0.1 * y; });
  const LayerSurface surface = whole_surface(rough_layers(0.0), plane, 4);
  for (int y = 100; y < 140; ++y)
    for (int x = 100; x < 140; ++x) {
      ASSERT_NEAR(surface.altitude_m(x, y),
                  300.0 + 0.2 * (2.5 * (x + 0.5) - 5.0) - 0.1 * (2.5 * (y + 0.5) - 5.0), 2e-3);
      // (-.2, -.1, 1) of unit length: the plane rises to the east and to the north.
      ASSERT_NEAR(surface.normal(x, y).x, -0.2 / std::sqrt(1.05), 1e-3);
      ASSERT_NEAR(surface.normal(x, y).y, -0.1 / std::sqrt(1.05), 1e-3);
    }
}

// No facets: second differences of a smooth hill, sampled eight times finer, are those of the hill,
// not zero inside cells and spikes at borders.
TEST(LayerSurface, HasNoFacets) {
  const auto hill = [](double x, double y) {
    return 200.0 * std::exp(-((x - 300.0) * (x - 300.0) + (y + 300.0) * (y + 300.0)) / 8000.0);
  };
  const LayerSurface surface = whole_surface(rough_layers(0.0), ground(60, hill), 8);
  constexpr double step = 1.25;
  for (int x = 200; x < 280; ++x) {
    const auto z = [&](int i) { return static_cast<double>(surface.altitude_m(i, 244)); };
    const double position = (x + 0.5) * step - 5.0;
    const double south = -((244 + 0.5) * step - 5.0);
    // Second differences over eight positions, so that the rounding of floats does not matter.
    const double measured = (z(x - 8) - 2.0 * z(x) + z(x + 8)) / (100.0);
    const double expected = (hill(position - 10.0, south) - 2.0 * hill(position, south) +
                             hill(position + 10.0, south)) /
                            100.0;
    ASSERT_NEAR(measured, expected, 3e-4) << x;
  }
}

// H' = H + C B D: bumps lie where the layer does, up to its roughness, and normals are of the
// displaced ground.
TEST(LayerSurface, BumpsAreAddedWhereTheLayerLies) {
  const Dem level = ground(40, [](double x, double) { return x < 200.0 ? 100.0 : 900.0; });
  const LayerSurface smooth = whole_surface(rough_layers(0.0), level, 4);
  const LayerSurface rough = whole_surface(rough_layers(2.0), level, 4);
  double largest = 0.0;
  double tilt = 0.0;
  for (int y = 10; y < 150; ++y)
    for (int x = 4; x < 156; ++x) {
      const double bump =
          std::abs(static_cast<double>(rough.altitude_m(x, y) - smooth.altitude_m(x, y)));
      ASSERT_LE(bump, 2.0);
      if (x > 100) {
        ASSERT_EQ(bump, 0.0);
      }
      largest = std::max(largest, bump);
      if (x < 60) tilt = std::max(tilt, static_cast<double>(1.F - rough.normal(x, y).z));
    }
  EXPECT_GT(largest, 0.5);
  EXPECT_GT(tilt, 0.01);
}

// Height passes on to the next layer: ground at 494 m is too low for layer b, which begins at 495
// m, except on the bumps of layer a.
TEST(LayerSurface, LaterLayersSeeTheDisplacedHeight) {
  const Dem level = ground(30, [](double, double) { return 494.0; });
  const auto white = [&](double roughness_m) {
    const LayerSurface surface = whole_surface(rough_layers(roughness_m), level, 4);
    return std::count_if(surface.colour.begin(), surface.colour.end(),
                         [](const glm::vec3& c) { return c.x > 254.F; });
  };
  EXPECT_EQ(white(0.0), 0);
  EXPECT_GT(white(6.0), 20);
}

TEST(LayerSurface, AnyRectangleHasTheBitsOfTheWhole) {
  const Dem dem = ground(80, [](double x, double y) {
    return 400.0 + 60.0 * std::sin(x / 70.0) * std::cos(y / 50.0) + 0.3 * x;
  });
  const LayerProgram program = compile_layers(rough_layers(1.0));
  const LayerGround made = make_layer_ground(dem, {}, program.inputs);
  const LayerSurface whole = layer_surface(program, made, 3, {0, 0, 240, 240}, 3);
  const PixelRect part{97, 101, 155, 140};
  const LayerSurface cut = layer_surface(program, made, 3, part, 3);
  EXPECT_EQ(part_of(whole.altitude_m, part), cut.altitude_m);
  EXPECT_EQ(part_of(whole.normal, part), cut.normal);
  EXPECT_EQ(part_of(whole.colour, part), cut.colour);
}

}  // namespace
}  // namespace belvedere
