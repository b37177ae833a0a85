#include "terrain/cover/layer_inputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "base/grid.h"
#include "base/random.h"
#include "terrain/cover/ground_variables.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

Dem ground(int width, int height, double cell_m,
           const std::function<double(double, double)>& altitude) {
  Dem dem;
  dem.altitude_m = Grid<float>(width, height);
  dem.filled = Grid<std::uint8_t>(width, height, 0);
  dem.transform = {1000.0, 5000.0, cell_m, cell_m};
  // Metres east and north of the centre.
  for (const auto [x, y] : test::cells(width, height))
    dem.altitude_m(x, y) =
        static_cast<float>(altitude(cell_m * (x - width / 2), -cell_m * (y - height / 2)));
  return dem;
}

Grid<float> one(const Dem& dem, const std::string& name) {
  return layer_inputs(make_layer_ground(dem, {}, {name})).at(0);
}

std::vector<std::string> names_from_the_ground() {
  std::vector<std::string> names;
  for (const std::string& name : layer_input_names())
    if (layer_input_kind(name) < LayerInputKind::temperature) names.push_back(name);
  return names;
}

// A window of a larger terrain gets the same values as the whole, also for inputs that reach beyond
// the window.
TEST(LayerInputs, WindowsLookBeyondThemselves) {
  const Dem whole = ground(480, 480, 60.0, [](double e, double n) {
    return 800.0 + 0.05 * e + 400.0 * std::sin(e / 2500.0) * std::cos(n / 3000.0);
  });
  Dem window = whole;
  const PixelRect cells{180, 200, 300, 310};
  window.altitude_m = part_of(whole.altitude_m, cells);
  window.filled = part_of(whole.filled, cells);
  window.transform.origin_x += 180 * 60.0;
  window.transform.origin_y -= 200 * 60.0;
  for (const char* name : {"relief_750", "relief_4000"}) {
    const Grid<float> of_whole = part_of(one(whole, name), cells);
    const Grid<float> joined = layer_inputs(make_layer_ground(window, {}, {name}, &whole)).at(0);
    const Grid<float> alone = one(window, name);
    float apart = 0.F;
    float apart_alone = 0.F;
    for (const auto [x, y] : test::cells({15, 15, 105, 95})) {
      apart = std::max(apart, std::abs(joined(x, y) - of_whole(x, y)));
      apart_alone = std::max(apart_alone, std::abs(alone(x, y) - of_whole(x, y)));
    }
    EXPECT_LT(apart, 1.5F) << name;
    if (std::string(name) == "relief_4000") {
      EXPECT_GT(apart_alone, 30.F);
    }
  }
  // A river that enters contributes its catchment.
  window.entries = {{60, 0, 500.0}};
  const Grid<float> area =
      layer_inputs(make_layer_ground(window, {}, {"log_catchment"}, &whole)).at(0);
  EXPECT_GT(*std::max_element(area.begin(), area.end()), 6.F);  // log2 of 64 km², blurred
  window.entries = {};
  const Grid<float> dry =
      layer_inputs(make_layer_ground(window, {}, {"log_catchment"}, &whole)).at(0);
  EXPECT_LT(*std::max_element(dry.begin(), dry.end()), 4.F);
}

// Rows run south: on a cone the north side faces north.
TEST(LayerInputs, ConeFacesOutwards) {
  const Dem cone =
      ground(201, 201, 20.0, [](double e, double n) { return 2000.0 - 0.5 * std::hypot(e, n); });
  const Grid<float> north = one(cone, "north");
  const Grid<float> east = one(cone, "east");
  // .5 / (.5 + .02) across.
  EXPECT_NEAR(north(100, 50), 0.9615, 0.002);
  EXPECT_NEAR(north(100, 150), -0.9615, 0.002);
  EXPECT_NEAR(one(cone, "south")(100, 150), 0.9615, 0.002);
  EXPECT_NEAR(east(150, 100), 0.9615, 0.002);
  EXPECT_NEAR(east(50, 100), -0.9615, 0.002);
  EXPECT_NEAR(north(150, 100), 0.0, 0.002);
  EXPECT_NEAR(north(100, 100), 0.0, 1e-3);
  EXPECT_NEAR(one(cone, "slope")(100, 50), 26.565, 0.05);
}

// A mean over a plane is the plane; over a wave of length l it is the wave times exp(-2 π² σ² /
// l²).
TEST(LayerInputs, ReliefOfPlanesAndWaves) {
  const Dem plane = ground(600, 600, 25.0, [](double e, double n) { return 0.1 * e - 0.05 * n; });
  for (const char* name : {"relief_180", "relief_750"})
    EXPECT_NEAR(one(plane, name)(300, 300), 0.0, 0.05) << name;
  constexpr double length = 3000.0;
  const Dem wave = ground(900, 900, 25.0, [](double e, double) {
    return 100.0 * std::cos(2.0 * std::acos(-1.0) * e / length);
  });
  const auto kept = [](double sigma) {
    return std::exp(-2.0 * std::pow(std::acos(-1.0) * sigma / length, 2.0));
  };
  for (const auto& [name, sigma] : {std::pair{"relief_180", 180.0}, std::pair{"relief_750", 750.0},
                                    std::pair{"relief_1800", 1800.0}})
    EXPECT_NEAR(one(wave, name)(450, 450),
                100.0 * (kept(sigma > 1000.0 ? 120.0 : 30.0) - kept(sigma)), 0.5)
        << name;
}

TEST(LayerInputs, ValleysFlatsAndRoughGround) {
  const Dem steps =
      ground(400, 300, 20.0, [](double e, double) { return e < 0.0 ? 500.0 : 800.0; });
  EXPECT_NEAR(one(steps, "above_valley")(180, 150), 0.0, 1.0);
  EXPECT_NEAR(one(steps, "above_valley")(210, 150), 300.0, 30.0);
  EXPECT_NEAR(one(steps, "above_valley")(390, 150), 0.0,
              1.0);  // beyond 900 m the high plain is the lowest ground
  const Grid<float> flat = one(steps, "flatness");
  EXPECT_EQ(flat(100, 100), 0.F);
  EXPECT_NEAR(flat(201, 100), std::log(301.0), 1e-3);
  EXPECT_EQ(flat(202, 100), 0.F);
  const Dem rough = ground(300, 300, 10.0, [](double e, double n) {
    return 100.0 +
           (random_bits(1, static_cast<std::int64_t>(e), static_cast<std::int64_t>(n)) % 2 == 0
                ? 4.0
                : -4.0);
  });
  EXPECT_NEAR(one(rough, "roughness")(150, 150), std::log(5.0), 0.02);
}

TEST(LayerInputs, CatchmentsGrowDownstream) {
  const Dem valley = ground(
      300, 300, 20.0, [](double e, double n) { return 1000.0 + 0.3 * std::abs(e) + 0.1 * n; });
  const Grid<float> log = one(valley, "log_catchment");
  EXPECT_LT(log(150, 20), log(150, 150));
  EXPECT_LT(log(150, 150), log(150, 290));
  EXPECT_GT(log(150, 150), log(170, 150) + 3.F);
}

TEST(LayerInputs, AnyRectangleHasTheBitsOfTheWhole) {
  const Dem dem = ground(700, 500, 4.0, [](double e, double n) {
    return 900.0 + 0.2 * e + 40.0 * std::sin(e / 90.0) * std::cos(n / 130.0) +
           static_cast<double>(
               random_bits(5, static_cast<std::int64_t>(e), static_cast<std::int64_t>(n)) % 100) /
               20.0;
  });
  const LayerGround made = make_layer_ground(dem, {}, names_from_the_ground());
  const std::vector<Grid<float>> whole = layer_inputs(made, {0, 0, 700, 500});
  const std::vector<Grid<float>> tiled = layer_inputs(made);
  const PixelRect part{313, 207, 390, 261};
  const std::vector<Grid<float>> cut = layer_inputs(made, part);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(whole[i], tiled[i]) << made.names[i];
    EXPECT_EQ(part_of(whole[i], part), cut[i]) << made.names[i];
  }
}

TEST(LayerInputs, ClimateIsGivenOrMissed) {
  const Dem dem = ground(20, 10, 10.0, [](double e, double) { return e; });
  const Error error = test::error_of([&] { make_layer_ground(dem, {}, {"altitude", "rain"}); });
  EXPECT_EQ(error.kind(), ErrorKind::usage);
  EXPECT_EQ(error.where(), "input rain");
  const Grid<float> rain(20, 10, 800.F);
  LayerClimate climate;
  climate.rain_mm = &rain;
  EXPECT_EQ(layer_inputs(make_layer_ground(dem, climate, {"rain"}), {3, 2, 9, 8})[0](5, 5), 800.F);
  EXPECT_THROW(make_layer_ground(dem, {}, {"altitud"}), Error);
}

TEST(LayerInputs, RangesAreOfThePercentiles) {
  Grid<float> values(1001, 1);
  for (int x = 0; x <= 1000; ++x) values(x, 0) = static_cast<float>(1000 - x);
  const LayerInput range = layer_input_range("altitude", values);
  EXPECT_EQ(range.low, 1.0);
  EXPECT_EQ(range.high, 999.0);
  Grid<std::uint8_t> use(1001, 1, 0);
  use(10, 0) = 1;
  const LayerInput single = layer_input_range("altitude", values, &use);
  EXPECT_LT(single.low, 990.0);
  EXPECT_GT(single.high, 990.0);
  use(10, 0) = 0;
  EXPECT_THROW(layer_input_range("altitude", values, &use), Error);
}

}  // namespace
}  // namespace belvedere
