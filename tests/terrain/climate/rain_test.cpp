#include "terrain/climate/rain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "tests/files.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

std::vector<Station> make_stations(int count) {
  std::vector<Station> stations;
  for (int i = 0; i < count; ++i) {
    Station station;
    station.position = {600000.0 + 60000.0 * random_uniform(3, i, 0),
                        5200000.0 + 50000.0 * random_uniform(3, i, 1)};
    station.altitude_m = 400.0 + 2400.0 * random_uniform(3, i, 2);
    station.rain_mm = 700.0 + 120.0 * station.altitude_m / 1000.0 +
                      2.0 * (station.position.x - 600000.0) / 1000.0 -
                      3.0 * (station.position.y - 5200000.0) / 1000.0;
    stations.push_back(station);
  }
  return stations;
}

TEST(Rain, GradientAndPlaneAreRecoveredThroughGrossErrors) {
  std::vector<Station> stations = make_stations(30);
  const RainPlane exact = fit_rain(stations);
  EXPECT_NEAR(exact.mm_per_km_up, 120.0, 1e-6);
  EXPECT_NEAR(exact.mm_per_km.x, 2.0, 1e-6);
  EXPECT_NEAR(exact.mm_per_km.y, -3.0, 1e-6);
  EXPECT_NEAR(exact.at({610000.0, 5210000.0}, 2000.0), 700.0 + 240.0 + 20.0 - 30.0, 1e-6);
  for (int i = 0; i < 30; ++i)
    stations[static_cast<std::size_t>(i)].rain_mm +=
        30.0 * random_normal(4, i, 0) + (i % 10 == 4 ? 900.0 : 0.0);
  const RainPlane robust = fit_rain(stations);
  EXPECT_NEAR(robust.mm_per_km_up, 120.0, 30.0);
  EXPECT_LT(robust.low_mm_per_km_up, 120.0);
  EXPECT_GT(robust.high_mm_per_km_up, 120.0);
}

// The three highest of thirty have far too much rain: least squares would infer a gradient.
TEST(Rain, WrongSummitsMakeNoGradient) {
  std::vector<Station> stations = make_stations(30);
  std::sort(stations.begin(), stations.end(),
            [](const Station& a, const Station& b) { return a.altitude_m > b.altitude_m; });
  for (std::size_t i = 0; i < 3; ++i) stations[i].rain_mm += 1500.0;
  for (int i = 0; i < 30; ++i)
    stations[static_cast<std::size_t>(i)].rain_mm += 10.0 * random_normal(4, i, 0);
  EXPECT_NEAR(fit_rain(stations).mm_per_km_up, 120.0, 25.0);
}

TEST(Rain, FewStationsTellLess) {
  EXPECT_EQ(fit_rain(make_stations(3)).mm_per_km_up, 0.0);
  EXPECT_EQ(fit_rain(make_stations(6)).mm_per_km, glm::dvec2(0.0));
  std::vector<Station> none = make_stations(4);
  for (Station& station : none) station.rain_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(test::message_of(ErrorKind::input, [&] { fit_rain(none); }), HasSubstr("rain"));
  // On one line, level: x and y cannot be separated.
  std::vector<Station> line = make_stations(12);
  for (Station& station : line) station.position.y = station.position.x, station.altitude_m = 500.0;
  EXPECT_TRUE(std::isfinite(fit_rain(line).at({600000.0, 600000.0}, 1000.0)));
}

TEST(Rain, TheOetztalIsAsItWasMeasured) {
  const std::string path = test::data_folder() + "/oetztal/HISTALP_oetztal.nc";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
  const RainPlane plane = fit_rain(read_stations(path, "EPSG:32632", silent_progress()).stations);
  EXPECT_NEAR(plane.mm_per_km_up, 57.0, 6.0);
  EXPECT_NEAR(plane.left_out_mm, 66.0, 2.0);
  EXPECT_LT(plane.low_mm_per_km_up, 35.0) << "it is not well known, and says so";
  EXPECT_GT(plane.high_mm_per_km_up, 80.0);
}

// A straight ridge of 1500 m across the wind that blows along rows; its half-width at e^-½ is 6 km.
Grid<float> make_ridge(int width, int height, bool along_rows) {
  Grid<float> ridge(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double away_m = ((along_rows ? x - 0.5 * (width - 1) : y - 0.5 * (height - 1))) * 200.0;
      ridge(x, y) = static_cast<float>(1500.0 * std::exp(-0.5 * away_m * away_m / 36e6));
    }
  return ridge;
}

double luv_by_lee(const Grid<float>& share, int centre, int row, int reach) {
  double luv = 0.0;
  double lee = 0.0;
  for (int i = 1; i <= reach; ++i) {
    luv += std::max(min_rain_share, 1.0F + share(centre - i, row));
    lee += std::max(min_rain_share, 1.0F + share(centre + i, row));
  }
  return luv / lee;
}

TEST(Rain, TheWindwardSideOfARidgeGetsMoreAndTurningTheWindTurnsIt) {
  const Grid<float> ridge = make_ridge(401, 21, true);
  const Grid<float> west = upslope_rain(ridge, {200.0, 200.0}, {.wind_from_deg = 270.0});
  EXPECT_GT(luv_by_lee(west, 200, 10, 45), 1.2);
  const Grid<float> east = upslope_rain(ridge, {200.0, 200.0}, {.wind_from_deg = 90.0});
  for (int x = 0; x < 401; ++x) EXPECT_NEAR(east(x, 10), west(400 - x, 10), 1e-5F) << x;
  // The same for a wind along columns.
  const Grid<float> upright = make_ridge(21, 401, false);
  const Grid<float> south = upslope_rain(upright, {200.0, 200.0}, {.wind_from_deg = 180.0});
  for (int y = 0; y < 401; ++y) EXPECT_NEAR(south(10, y), west(400 - y, 10), 1e-5F) << y;
  // Long delays move the rain behind the ridge.
  EXPECT_LT(luv_by_lee(upslope_rain(ridge, {200.0, 200.0}, {.delay_s = 1000.0}), 200, 10, 45), 1.0);
}

TEST(Rain, TailsAreTheTransferFunctionOfWaves) {
  // c iσ ĥ / (1 + iσT)² for a wave of ground, σ = U k: its amplitude and phase, away from the
  // upwind border.
  constexpr double wave_m = 9000.0;
  Grid<float> waves(2000, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 2000; ++x)
      waves(x, y) =
          static_cast<float>(200.0 * std::cos(2.0 * 3.14159265358979 * x * 50.0 / wave_m));
  const UpslopeParameters parameters{.wind_from_deg = 270.0};
  const Grid<float> rain = upslope_rain(waves, {50.0, 50.0}, parameters);
  const double sigma = parameters.wind_m_s * 2.0 * 3.14159265358979 / wave_m;
  const double delayed = sigma * parameters.delay_s;
  const double amplitude = parameters.strength * sigma * 200.0 / (1.0 + delayed * delayed);
  const double phase = 0.5 * 3.14159265358979 - 2.0 * std::atan(delayed);
  // Ground between cells is even: half a cell of delay.
  for (int x = 1500; x < 1700; ++x) {
    const double expected =
        amplitude * std::cos(2.0 * 3.14159265358979 * (x - 0.0) * 50.0 / wave_m + phase);
    EXPECT_NEAR(rain(x, 1), expected, 0.02 * amplitude) << x;
  }
}

TEST(Rain, ObliqueWindsLeaveNoSeamAndVoidsAreLevel) {
  Grid<float> hill(200, 180, 0.0F);
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 200; ++x)
      hill(x, y) = static_cast<float>(
          1200.0 * std::exp(-(std::pow(x - 100.0, 2.0) + std::pow(y - 90.0, 2.0)) / 800.0));
  const Grid<float> share = upslope_rain(hill, {300.0, 300.0}, {.wind_from_deg = 237.0});
  for (int y = 1; y + 1 < 180; ++y)
    for (int x = 1; x + 1 < 200; ++x)
      EXPECT_LT(std::abs(share(x - 1, y) - 2.0F * share(x, y) + share(x + 1, y)), 0.02F)
          << x << ' ' << y;
  hill(100, 90) = std::numeric_limits<float>::quiet_NaN();
  for (const float value : upslope_rain(hill, {300.0, 300.0}, {.wind_from_deg = 237.0}))
    ASSERT_TRUE(std::isfinite(value));
  EXPECT_THAT(test::message_of(ErrorKind::usage,
                               [&] {
                                 upslope_rain(hill, {300.0, 300.0}, {.delay_s = 0.0});
                               }),
              HasSubstr("delay_s"));
}

}  // namespace
}  // namespace belvedere
