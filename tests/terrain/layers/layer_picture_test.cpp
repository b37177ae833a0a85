#include "terrain/layers/layer_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/filter.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "tests/grids.h"
#include "tests/terrain/layers/metres.h"

namespace belvedere {
namespace {

SurfaceLayers one_colour(std::uint32_t rgb) {
  SurfaceLayers layers;
  layers.ground_rgb = rgb;
  layers.inputs = {{"altitude", 0.0, 1000.0}};
  layers.layers.resize(1);
  layers.layers[0].name = "nowhere";
  layers.layers[0].functions = {LayerHat{4000.0, 5000.0, 0.0, 0.0}};
  return layers;
}

Grid<glm::vec3> drawn(const Dem& dem, const SurfaceLayers& layers,
                      const LayerPictureParameters& parameters) {
  Grid<glm::vec3> all(dem.width() * parameters.finer, dem.height() * parameters.finer);
  draw_layer_picture(
      layers, dem, {}, parameters,
      [&](int y0, const Grid<glm::vec3>& rows) {
        std::copy(rows.begin(), rows.end(), all.row(y0));
      },
      silent_progress());
  return all;
}

Dem ramp(int size, float rise_east, float rise_south) {
  Dem dem;
  dem.altitude_m = Grid<float>(size, size);
  dem.filled = Grid<std::uint8_t>(size, size, 0);
  dem.transform = {1000.0, 5000.0, 10.0, 10.0};
  for (const auto [x, y] : test::cells(size, size))
    dem.altitude_m(x, y) =
        400.F + 10.F * (rise_east * static_cast<float>(x) + rise_south * static_cast<float>(y));
  return dem;
}

// Lambert's cosine over that of level ground: level ground keeps its colour, a slope that faces
// light 45° high gets √2 of it, one that faces away only the shade.
TEST(LayerPicture, BrightnessIsLambertsCosine) {
  const LayerPictureParameters light{.light_from = 90.0, .light_height = 45.0, .shade = 0.25};
  EXPECT_NEAR(SlopeLight(light).brightness({0.F, 0.F, 1.F}), 1.0, 1e-6);
  const float half = std::sqrt(0.5F);
  EXPECT_NEAR(SlopeLight(light).brightness({half, 0.F, half}), 0.25 + 0.75 * std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(SlopeLight(light).brightness({-half, 0.F, half}), 0.25, 1e-6);
  LayerPictureParameters twice = light;
  twice.relief = 2.0;
  const glm::vec3 gentle = glm::normalize(glm::vec3(0.2F, 0.1F, 1.F));
  const glm::vec3 steep = glm::normalize(glm::vec3(0.4F, 0.2F, 1.F));
  EXPECT_NEAR(SlopeLight(twice).brightness(gentle), SlopeLight(light).brightness(steep), 1e-6);
}

TEST(LayerPicture, APlaneHasOneColourAtAnyFineness) {
  const Dem plane = ramp(60, 0.3F, 0.F);  // rises to the east: turned to light from the west
  for (const int finer : {1, 3, 8}) {
    const LayerPictureParameters parameters{.finer = finer, .light_from = 270.0};
    const Grid<glm::vec3> picture = drawn(plane, one_colour(0x804020), parameters);
    const float brightness =
        SlopeLight(parameters).brightness(glm::normalize(glm::vec3(-0.3F, 0.F, 1.F)));
    EXPECT_GT(brightness, 1.1F);
    const glm::vec3 centre = picture(30 * finer, 30 * finer);
    EXPECT_NEAR(centre.x, 128.F * brightness, 0.3F) << finer;
    EXPECT_NEAR(centre.y, 64.F * brightness, 0.3F) << finer;
  }
}

// A level lake in a bowl: pale at its shore, deep at the centre; without beds it is its layers'
// ground.
TEST(LayerPicture, LakesShowTheirBeds) {
  Dem bowl = ramp(120, 0.F, 0.F);
  for (const auto [x, y] : test::cells(120, 120)) {
    const double out = std::hypot(x - 60.0, y - 60.0);
    if (out > 35.0) bowl.altitude_m(x, y) = static_cast<float>(400.0 + 3.0 * (out - 35.0));
  }
  const LayerPictureParameters parameters{.finer = 2};
  const SurfaceLayers brown = one_colour(0x806040);
  const Grid<glm::vec3> seen = drawn(bowl, brown, parameters);
  const auto luminance = [](const glm::vec3& c) { return c.x + c.y + c.z; };
  EXPECT_GT(seen(120, 120).z, seen(120, 120).x);  // blue
  EXPECT_LT(luminance(seen(120, 120)), luminance(seen(120 - 64, 120)));
  LayerPictureParameters bare = parameters;
  bare.beds = false;
  EXPECT_NEAR(drawn(bowl, brown, bare)(120, 120).x, 128.F, 0.5F);
}

// Water is level, whatever bumps its bed has; the shore is not.
TEST(LayerPicture, LakesAreLitAsLevel) {
  Dem bowl = ramp(80, 0.F, 0.F);
  for (const auto [x, y] : test::cells(80, 80)) {
    const double out = std::hypot(x - 40.0, y - 40.0);
    if (out > 25.0) bowl.altitude_m(x, y) = static_cast<float>(400.0 + 3.0 * (out - 25.0));
  }
  SurfaceLayers stones = one_colour(0x806040);
  stones.layers[0].functions = {LayerHat{0.0, 1000.0, 0.0, 0.0}};
  stones.layers[0].rgb = 0x806040;
  stones.layers[0].roughness_m = 3.0;
  stones.layers[0].roughness_scale_m = 40.0;
  const Grid<glm::vec3> lit = drawn(bowl, stones, {.finer = 2});
  const Grid<glm::vec3> flat = drawn(bowl, stones, {.finer = 2, .relief = 0.0});
  int different = 0;
  for (const auto [x, y] : test::cells({0, 60, 160, 100})) {
    const bool in_lake = std::hypot(x - 80.5, y - 80.5) < 44.0;
    if (in_lake) {
      ASSERT_EQ(lit(x, y), flat(x, y)) << x << ' ' << y;
    }
    if (!in_lake && lit(x, y) != flat(x, y)) ++different;
  }
  EXPECT_GT(different, 500);
}

TEST(LayerPicture, ThreadsLeaveNoTrace) {
  Dem rough = ramp(150, 0.1F, 0.2F);
  SurfaceLayers layers = one_colour(0x608040);
  layers.layers[0].name = "stones";
  layers.layers[0].rgb = 0xc0c0c0;
  layers.layers[0].roughness_m = 3.0;
  layers.layers[0].noise = {40.0, 3, 0.5, 0.6};
  layers.layers[0].functions = {LayerHat{0.0, 500.0, 1.0, 50.0}};
  const LayerPictureParameters parameters{.finer = 4, .seed = 5};
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return drawn(rough, layers, parameters);
  };
  const Grid<glm::vec3> one = with(1);
  EXPECT_EQ(one, with(2));
  // The layer's bumps are lit.
  LayerPictureParameters flat = parameters;
  flat.relief = 0.0;
  EXPECT_NE(one, drawn(rough, layers, flat));
}

TEST(LayerPicture, SaysWhatIsAllowed) {
  EXPECT_THROW(check_layer_picture({.finer = 0}), Error);
  EXPECT_THROW(check_layer_picture({.finer = 17}), Error);
  EXPECT_THROW(check_layer_picture({.light_height = 4.0}), Error);
  EXPECT_THROW(check_layer_picture({.shade = 1.5}), Error);
  EXPECT_NO_THROW(check_layer_picture({}));
  EXPECT_THROW(drawn(ramp(4, 0.F, 0.F), SurfaceLayers(), {}), Error);
}

Dem ground(int size, const std::function<double(double, double)>& altitude) {
  Dem dem;
  dem.altitude_m = Grid<float>(size, size);
  dem.filled = Grid<std::uint8_t>(size, size, 0);
  dem.transform = {1000.0, 5000.0, 10.0, 10.0};
  for (const auto [x, y] : test::cells(size, size))
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
  for (const auto [x, y] : test::cells({100, 100, 140, 140})) {
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
  for (const auto [x, y] : test::cells({4, 10, 156, 150})) {
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
  SurfaceLayers layers = rough_layers(1.0);
  layers.layers[0].roughness_scale_m = 30.0;
  layers.layers[1].functions[1] = LayerHat{8.0, INFINITY, 10.0, 0.0};  // of slopes with bumps
  layers.layers[1].when = "altitude > 380";
  const Dem dem = ground(80, [](double x, double y) {
    return 400.0 + 60.0 * std::sin(x / 70.0) * std::cos(y / 50.0) + 0.3 * x;
  });
  const LayerProgram program = compile_layers(layers);
  ASSERT_EQ(handed_on(program, 10.0 / 3.0), 1);
  const LayerGround made = make_layer_ground(dem, {}, program.inputs);
  const LayerSurface whole = layer_surface(program, made, 3, {0, 0, 240, 240}, 3);
  const PixelRect part{97, 101, 155, 140};
  const LayerSurface cut = layer_surface(program, made, 3, part, 3);
  EXPECT_EQ(part_of(whole.altitude_m, part), cut.altitude_m);
  EXPECT_EQ(part_of(whole.normal, part), cut.normal);
  EXPECT_EQ(part_of(whole.colour, part), cut.colour);
}

using test::metres;
using enum LandCoverClass;

std::vector<Grid<float>> no_shares(int width, int height) {
  return std::vector<Grid<float>>(static_cast<std::size_t>(land_cover_class_count),
                                  Grid<float>(width, height));
}
Grid<float>& of(std::vector<Grid<float>>& shares, LandCoverClass id) {
  return shares[static_cast<std::size_t>(id)];
}

double frequency(const Grid<LandCoverClass>& classes, LandCoverClass id) {
  return static_cast<double>(std::count(classes.begin(), classes.end(), id)) /
         static_cast<double>(classes.size());
}

std::vector<Grid<float>> constant_shares(int size) {
  std::vector<Grid<float>> shares = no_shares(size, size);
  of(shares, forest) = Grid<float>(size, size, 0.55F);
  of(shares, rock) = Grid<float>(size, size, 0.3F);
  of(shares, snow) = Grid<float>(size, size, 0.12F);
  of(shares, water) = Grid<float>(size, size, 0.03F);
  return shares;
}

// Without sharpening the frequency is the share, for any spectrum of the noise.
TEST(LayerDrawing, FrequencyIsTheShare) {
  for (const double spectrum : {0.0, 0.5, 2.0}) {
    const LayerDrawingParameters parameters{.power = 1.0, .octaves = 4, .spectrum = spectrum};
    const std::vector<Grid<float>> shares = constant_shares(700);
    const Grid<LandCoverClass> drawn =
        draw_classes(plan_layer_drawing(parameters, shares), shares, metres, {0, 0, 700, 700});
    EXPECT_NEAR(frequency(drawn, forest), 0.55, 0.015) << spectrum;
    EXPECT_NEAR(frequency(drawn, rock), 0.30, 0.015) << spectrum;
    EXPECT_NEAR(frequency(drawn, snow), 0.12, 0.01) << spectrum;
    EXPECT_NEAR(frequency(drawn, water), 0.03, 0.006) << spectrum;
  }
}

// From forest to rock over the region, with a little snow on rock: sharpened shares have the same
// total frequency, but are less mixed.
TEST(LayerDrawing, SharpeningKeepsMeanShares) {
  constexpr int size = 600;
  std::vector<Grid<float>> shares = no_shares(size, size);
  for (const auto [x, y] : test::cells(size, size)) {
    const float t = static_cast<float>(x) / size;
    of(shares, forest)(x, y) = 1.F - t;
    of(shares, rock)(x, y) = 0.8F * t;
    of(shares, snow)(x, y) = 0.2F * t;
  }
  const auto drawn_by = [&](double power) {
    LayerDrawingParameters parameters;
    parameters.power = power;
    return draw_classes(plan_layer_drawing(parameters, shares), shares, metres, {0, 0, size, size});
  };
  const auto mixing = [&](const Grid<LandCoverClass>& drawn) {
    int edges = 0;
    for (const auto [x, y] : test::cells({1, 0, size, size}))
      edges += drawn(x, y) != drawn(x - 1, y) ? 1 : 0;
    return edges;
  };
  const Grid<LandCoverClass> as_shares_say = drawn_by(1.0);
  for (const double power : {2.0, 3.0}) {
    const Grid<LandCoverClass> drawn = drawn_by(power);
    EXPECT_NEAR(frequency(drawn, forest), 0.5, 0.02) << power;
    EXPECT_NEAR(frequency(drawn, rock), 0.4, 0.02) << power;
    EXPECT_NEAR(frequency(drawn, snow), 0.1, 0.02) << power;
    EXPECT_LT(mixing(drawn), 0.8 * mixing(as_shares_say)) << power;
  }
}

TEST(LayerDrawing, LargeSpectraMakeLargePatches) {
  const std::vector<Grid<float>> shares = constant_shares(400);
  const auto edges = [&](double spectrum) {
    LayerDrawingParameters parameters;
    parameters.spectrum = spectrum;
    const Grid<LandCoverClass> drawn =
        draw_classes(plan_layer_drawing(parameters, shares), shares, metres, {0, 0, 400, 400});
    int count = 0;
    for (const auto [x, y] : test::cells({1, 0, 400, 400}))
      count += drawn(x, y) != drawn(x - 1, y) ? 1 : 0;
    return count / (400.0 * 399.0);
  };
  EXPECT_GT(edges(0.0), 2.0 * edges(2.0));
}

TEST(LayerDrawing, AnyRectangleHasTheBitsOfTheWhole) {
  const std::vector<Grid<float>> shares = constant_shares(150);
  const PixelRect part{31, 17, 120, 133};
  std::vector<Grid<float>> cut;
  for (const Grid<float>& grid : shares) cut.push_back(part_of(grid, part));
  const LayerDrawing drawing = plan_layer_drawing({}, shares);
  const Grid<LandCoverClass> whole = draw_classes(drawing, shares, metres, {0, 0, 150, 150});
  EXPECT_EQ(part_of(whole, part), draw_classes(drawing, cut, metres, part));
}

TEST(LayerDrawing, NothingIsDrawnWhereNothingIs) {
  std::vector<Grid<float>> shares = no_shares(4, 1);
  of(shares, sky)(0, 0) = 1.F;
  of(shares, rock)(1, 0) = 1e-6F;
  const Grid<LandCoverClass> drawn =
      draw_classes(plan_layer_drawing({}, shares), shares, metres, {0, 0, 4, 1});
  EXPECT_EQ(drawn(0, 0), sky);
  EXPECT_EQ(drawn(1, 0), rock);
  EXPECT_THROW(plan_layer_drawing({.power = 0.5}, shares), Error);
}

}  // namespace
}  // namespace belvedere
