#include "terrain/climate/radiation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <numbers>
#include <vector>

#include "base/math.h"
#include "base/parallel.h"
#include "terrain/climate/horizon_sweep.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "terrain/synthetic/synthetic.h"
#include "tests/files.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

constexpr double cell_m = 30.0;

MapPosition flat_position(int width, int height, double latitude_deg) {
  MapPosition position;
  position.width = width;
  position.height = height;
  position.cell_m = {cell_m, cell_m};
  position.latitude_deg.at_first = latitude_deg;
  return position;
}

// A plane that falls towards an azimuth of the map; its centre is at 1000 m.
Grid<float> make_plane(double slope_deg, double towards_deg, int size = 33) {
  Grid<float> plane(size, size);
  const double fall = std::tan(to_radians(slope_deg)) * cell_m;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      plane(x, y) =
          static_cast<float>(1000.0 - fall * ((x - size / 2) * std::sin(to_radians(towards_deg)) -
                                              (y - size / 2) * std::cos(to_radians(towards_deg))));
  return plane;
}

// A year above the atmosphere on a slope that faces the equator (or away from it: below 0),
// northern latitudes: the day of level ground at latitude - slope, while the sun is above both
// horizons (Iqbal 1983).
double year_on_slope_mj(double latitude_deg, double slope_deg) {
  double sum = 0.0;
  for (int day = 1; day <= 365; ++day) {
    const SunOfDay sun = sun_of_day(day);
    const auto sunset = [&](double latitude) {
      return std::acos(std::clamp(-std::tan(latitude) * std::tan(sun.declination_rad), -1.0, 1.0));
    };
    const double there = to_radians(latitude_deg - slope_deg);
    const double set = std::min(sunset(to_radians(latitude_deg)), sunset(there));
    sum += std::max(0.0, 24.0 / std::numbers::pi * 3600e-6 * 1367.0 * sun.nearness *
                             (std::cos(there) * std::cos(sun.declination_rad) * std::sin(set) +
                              set * std::sin(there) * std::sin(sun.declination_rad)));
  }
  return sum;
}

TEST(Radiation, PlanesGetWhatTheClosedFormSays) {
  const ThreadLimit one(1);  // so little ground is no work for two
  RadiationParameters above_the_air;
  above_the_air.sun.transmissivity = 1.0;
  double worst = 0.0;
  for (const double latitude : {0.0, 20.0, 47.0, 60.0})
    for (const double slope : {-40.0, -20.0, -10.0, 0.0, 10.0, 25.0, 40.0}) {
      if (latitude > 50.0 && slope < -20.0)
        continue;  // the sun shines twice a day there: another formula
      const Grid<float> plane = make_plane(std::abs(slope), slope < 0.0 ? 0.0 : 180.0, 9);
      const Radiation radiation =
          potential_radiation(plane, flat_position(9, 9, latitude), above_the_air);
      const double expected = year_on_slope_mj(latitude, slope);
      worst = std::max(worst, std::abs(radiation.direct_mj_m2(4, 4) / expected - 1.0));
      EXPECT_NEAR(radiation.direct_mj_m2(4, 4), expected, 0.0015 * expected)
          << latitude << ' ' << slope;
    }
  RecordProperty("worst", std::to_string(worst));
}

TEST(Radiation, LevelGroundInAPitGetsTheSunAboveItsRim) {
  // A ring whose edge is 10° above the horizon all around.
  constexpr int size = 201;
  Grid<float> pit(size, size, 0.0F);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      if (std::hypot(x - 100.0, y - 100.0) > 80.0)
        pit(x, y) = static_cast<float>(std::tan(to_radians(10.0)) * 80.5 * cell_m);
  const RadiationParameters parameters;
  const Radiation radiation = potential_radiation(pit, flat_position(size, size, 47.0), parameters);
  double expected = 0.0;
  for (const SunMoment& sun : sun_moments(47.0, parameters.sun))
    if (sun.sine > std::sin(to_radians(10.0)))
      expected += sun.exposure_mj * sun.sine * clear_share(0.75, sun.air_mass, 0.0);
  EXPECT_NEAR(radiation.direct_mj_m2(100, 100), expected, 0.002 * expected);
  EXPECT_NEAR(radiation.sky_view(100, 100), std::pow(std::cos(to_radians(10.0)), 2.0), 0.002);
}

// P41: a sun that always shines is a clear sky, bit for bit; one that never shines leaves a third
// of the light of level ground to the visible sky, the same on all sides; between, the light is
// mixed.
TEST(Radiation, CloudsHaveAClosedFormAtNoneAndAll) {
  constexpr double slope_deg = 30.0;
  const MapPosition position = flat_position(9, 9, 47.0);
  const auto light = [&](const Grid<float>& ground, const std::vector<float>& sunshine) {
    RadiationParameters parameters;
    parameters.sun.step_min = 10.0;
    parameters.sun.sunshine = shares_of_months(sunshine, "sunshine");
    return potential_radiation(ground, position, parameters);
  };
  RadiationParameters clear;
  clear.sun.step_min = 10.0;
  const Grid<float> level(9, 9, 1000.F);
  const float level_mj = potential_radiation(level, position, clear).direct_mj_m2(4, 4);
  EXPECT_NEAR(light(level, {0.F}).direct_mj_m2(4, 4), level_mj / 3.F, 1e-3F * level_mj);
  std::vector<float> half_year(12, 0.F);
  std::fill(half_year.begin() + 3, half_year.begin() + 9, 1.F);
  std::vector<float> other_half;
  for (const float share : half_year) other_half.push_back(1.F - share);
  for (const double towards_deg : {0.0, 90.0, 180.0}) {
    const Grid<float> plane = make_plane(slope_deg, towards_deg, 9);
    const Radiation sunny = potential_radiation(plane, position, clear);
    EXPECT_EQ(light(plane, {1.F}).direct_mj_m2, sunny.direct_mj_m2);
    const Radiation cloudy = light(plane, {0.F});
    // The plane hides the sky below it: the mean of cos² of its own horizon is (1 + cos) / 2.
    const double sky = 0.5 * (1.0 + std::cos(to_radians(slope_deg)));
    EXPECT_NEAR(cloudy.direct_mj_m2(4, 4), level_mj / 3.0 * sky, 0.005 * level_mj) << towards_deg;
    EXPECT_NEAR(light(plane, {0.25F}).direct_mj_m2(4, 4),
                0.25F * sunny.direct_mj_m2(4, 4) + 0.75F * cloudy.direct_mj_m2(4, 4),
                1e-3F * level_mj);
    // April to September alone, and the other months alone: together once clear and once in cloud.
    const float summer = light(plane, half_year).direct_mj_m2(4, 4);
    const float winter = light(plane, other_half).direct_mj_m2(4, 4);
    EXPECT_NEAR(summer + winter, sunny.direct_mj_m2(4, 4) + cloudy.direct_mj_m2(4, 4),
                1e-3F * level_mj);
    EXPECT_GT(summer, 1.1F * winter);
  }
  EXPECT_THAT(test::message_of(ErrorKind::usage,
                               [] {
                                 shares_of_months({0.5F, 0.5F}, "sunshine");
                               }),
              testing::HasSubstr("twelve"));
  EXPECT_THAT(test::message_of(ErrorKind::usage, [] { shares_of_months({1.5F}, "sunshine"); }),
              testing::HasSubstr("0 … 1"));
}

TEST(Radiation, IsWhatRaysThatMarchOverTheGroundFind) {
  const std::string path = test::data_folder() + "/innsbruck/innsbruck_utm32_30m.tif";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
  // The Karwendel: walls of 1000 m. A map of its own, so that rays end where sweeps do.
  RasterSource source;
  source.path = path;
  const Grid<float> whole = read_raster(source).cells;
  constexpr int size = 300;
  Grid<float> ground(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) ground(x, y) = whole(900 + x, 2150 + y);
  RadiationParameters parameters;
  parameters.sun.step_min = 10.0;
  const double latitude = 46.5;
  const Radiation radiation =
      potential_radiation(ground, flat_position(size, size, latitude), parameters);
  parameters.azimuths = 64;
  const Radiation finer =
      potential_radiation(ground, flat_position(size, size, latitude), parameters);
  const std::vector<SunMoment> moments = sun_moments(latitude, parameters.sun);
  const auto height = [&](double x, double y) {
    const int x0 = std::min(static_cast<int>(x), size - 2);
    const int y0 = std::min(static_cast<int>(y), size - 2);
    const double fx = x - x0;
    const double fy = y - y0;
    return (ground(x0, y0) * (1 - fx) + ground(x0 + 1, y0) * fx) * (1 - fy) +
           (ground(x0, y0 + 1) * (1 - fx) + ground(x0 + 1, y0 + 1) * fx) * fy;
  };
  constexpr int directions = 1440;
  double square = 0.0;
  double finer_square = 0.0;
  double mean = 0.0;
  double sky_square = 0.0;
  int count = 0;
  for (int y = 40; y < 270; y += 17)
    for (int x = 40; x < 270; x += 17) {
      const double east = (ground(x + 1, y) - ground(x - 1, y)) / (2.0 * cell_m);
      const double north = (ground(x, y - 1) - ground(x, y + 1)) / (2.0 * cell_m);
      const double length = std::sqrt(1.0 + east * east + north * north);
      std::vector<double> horizon(directions, 0.0);
      double sky = 0.0;
      for (int d = 0; d < directions; ++d) {
        const double a = 2.0 * std::numbers::pi * (d + 0.5) / directions;
        double highest = std::max(0.0, east * std::sin(a) + north * std::cos(a));
        for (double t = 1.0;; t += 0.25) {
          const double px = x + t * std::sin(a);
          const double py = y - t * std::cos(a);
          if (px < 0 || py < 0 || px > size - 1 || py > size - 1) break;
          highest = std::max(highest, (height(px, py) - ground(x, y)) / (t * cell_m));
        }
        horizon[static_cast<std::size_t>(d)] = highest;
        sky += 1.0 / (1.0 + highest * highest) / directions;
      }
      double sum = 0.0;
      for (const SunMoment& sun : moments) {
        const auto d =
            static_cast<std::size_t>(sun.azimuth_rad / (2.0 * std::numbers::pi) * directions) %
            directions;
        if (sun.sine <= horizon[d] * sun.cosine) continue;
        const double facing = (sun.sine - sun.cosine * (east * std::sin(sun.azimuth_rad) +
                                                        north * std::cos(sun.azimuth_rad))) /
                              length;
        sum += std::max(0.0, facing) * sun.exposure_mj *
               clear_share(0.75, sun.air_mass, static_cast<double>(ground(x, y)));
      }
      square += std::pow(radiation.direct_mj_m2(x, y) - sum, 2.0);
      finer_square += std::pow(finer.direct_mj_m2(x, y) - sum, 2.0);
      sky_square += std::pow(radiation.sky_view(x, y) - sky, 2.0);
      mean += sum;
      ++count;
    }
  mean /= count;
  const double rms = std::sqrt(square / count) / mean;
  RecordProperty("rms", std::to_string(rms));
  const double finer_rms = std::sqrt(finer_square / count) / mean;
  RecordProperty("finer", std::to_string(finer_rms));
  EXPECT_LT(rms, 0.0020)
      << "of the mean; .00195 was measured: what is left between 32 directions of such walls";
  EXPECT_LT(finer_rms, 0.0011);
  EXPECT_LT(std::sqrt(sky_square / count), 0.003);
}

TEST(Radiation, TrueNorthIsWhereTheMapSaysItIs) {
  const ThreadLimit one(1);  // so little ground is no work for two
  // The columns of this map run towards 30° east of north: a slope to its east faces 120°.
  const RadiationParameters parameters;
  MapPosition leaning = flat_position(33, 33, 47.0);
  leaning.grid_north_deg.at_first = 30.0;
  const float leant =
      potential_radiation(make_plane(25.0, 90.0), leaning, parameters).direct_mj_m2(16, 16);
  const float upright =
      potential_radiation(make_plane(25.0, 120.0), flat_position(33, 33, 47.0), parameters)
          .direct_mj_m2(16, 16);
  const float unturned =
      potential_radiation(make_plane(25.0, 90.0), flat_position(33, 33, 47.0), parameters)
          .direct_mj_m2(16, 16);
  EXPECT_NEAR(leant, upright, 2e-4F * upright);
  EXPECT_GT(std::abs(unturned / upright - 1.0F), 0.05F);
  // And it varies over the map, from 0 on the left.
  MapPosition changing = flat_position(33, 33, 47.0);
  changing.grid_north_deg.per_column = 3.0 / 32.0;
  const Radiation over = potential_radiation(make_plane(25.0, 90.0), changing, parameters);
  const Radiation same =
      potential_radiation(make_plane(25.0, 90.0), flat_position(33, 33, 47.0), parameters);
  const float by_3_deg =
      potential_radiation(make_plane(25.0, 93.0), flat_position(33, 33, 47.0), parameters)
          .direct_mj_m2(16, 16) -
      unturned;
  EXPECT_NEAR(over.direct_mj_m2(30, 16) - same.direct_mj_m2(30, 16), by_3_deg * 30.0F / 32.0F,
              0.06F * by_3_deg);
  EXPECT_NEAR(over.direct_mj_m2(3, 16) - same.direct_mj_m2(3, 16), by_3_deg * 3.0F / 32.0F,
              0.06F * by_3_deg);
}

TEST(Radiation, LatitudeChangesOverTheMapWithoutASeam) {
  constexpr int size = 120;
  const Grid<float> level(size, size, 500.0F);
  MapPosition position = flat_position(size, size, 50.0);
  position.latitude_deg.per_row = -3.0 / (size - 1);
  const Radiation radiation = potential_radiation(level, position, {});
  for (const int row : {0, 40, 119}) {
    const double latitude = position.latitude_deg.at(0, row);
    const float alone =
        potential_radiation(Grid<float>(3, 3, 500.0F), flat_position(3, 3, latitude), {})
            .direct_mj_m2(1, 1);
    EXPECT_NEAR(radiation.direct_mj_m2(60, row), alone, 3e-4F * alone) << row;
  }
  for (int y = 2; y < size; ++y) {
    const float step = radiation.direct_mj_m2(60, y) - radiation.direct_mj_m2(60, y - 1);
    const float before = radiation.direct_mj_m2(60, y - 1) - radiation.direct_mj_m2(60, y - 2);
    EXPECT_NEAR(step, before, 0.1F * before + 0.05F) << y;
  }
}

TEST(Radiation, SunnySidesGetMoreThanShadyOnesInEitherHemisphere) {
  const ThreadLimit one(1);  // so little ground is no work for two
  for (const double latitude : {47.0, -33.0}) {
    const double sunny = latitude > 0.0 ? 180.0 : 0.0;
    const float warm =
        potential_radiation(make_plane(30.0, sunny), flat_position(33, 33, latitude), {})
            .direct_mj_m2(16, 16);
    const float cold =
        potential_radiation(make_plane(30.0, 180.0 - sunny), flat_position(33, 33, latitude), {})
            .direct_mj_m2(16, 16);
    EXPECT_GT(warm, 1.8F * cold);
  }
  const float east = potential_radiation(make_plane(30.0, 90.0), flat_position(33, 33, 47.0), {})
                         .direct_mj_m2(16, 16);
  const float west = potential_radiation(make_plane(30.0, 270.0), flat_position(33, 33, 47.0), {})
                         .direct_mj_m2(16, 16);
  EXPECT_NEAR(east, west, 1e-4F * east);
}

TEST(Radiation, VoidsGetNothingAndAnyThreadsTheSameBits) {
  SyntheticParameters synthetic;
  synthetic.width = 130;
  synthetic.height = 97;
  Grid<float> ground = make_ridged_noise(synthetic).altitude_m;
  for (int i = 20; i < 60; ++i)
    ground(i, 40) = ground(70, i) = std::numeric_limits<float>::quiet_NaN();
  RadiationParameters parameters;
  parameters.azimuths = 16;
  parameters.sun.step_min = 10.0;
  const MapPosition position = flat_position(130, 97, 47.0);
  const Radiation all = potential_radiation(ground, position, parameters);
  for (std::size_t i = 0; i < ground.size(); ++i) {
    ASSERT_EQ(std::isnan(all.direct_mj_m2[i]), std::isnan(ground[i]));
    ASSERT_EQ(std::isnan(all.sky_view[i]), std::isnan(ground[i]));
    if (!std::isnan(ground[i])) {
      ASSERT_GE(all.direct_mj_m2[i], 0.0F);
    }
  }
  const ThreadLimit one(1);
  const Radiation alone = potential_radiation(ground, position, parameters);
  for (std::size_t i = 0; i < ground.size(); ++i) {
    if (std::isnan(ground[i])) continue;
    ASSERT_EQ(all.direct_mj_m2[i], alone.direct_mj_m2[i]);
    ASSERT_EQ(all.sky_view[i], alone.sky_view[i]);
  }
}

TEST(RadiationLong, CorrelatesWithGrassRSun) {
  if (std::system("test -x /usr/bin/grass") != 0)
    GTEST_SKIP() << "needs GRASS GIS (Debian: grass-core)";
  // On the meridian of UTM 32, 47.5° N; smooth hills, because r.sun uses another formula for
  // slopes.
  constexpr int size = 120;
  Grid<float> hills(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      hills(x, y) = static_cast<float>(1500.0 + 150.0 * std::sin(x / 9.0) * std::cos(y / 11.0) +
                                       80.0 * std::sin((x + 2 * y) / 17.0) + 3.0 * y);
  const test::Folder folder;
  folder.write("z.bin",
               {reinterpret_cast<const char*>(hills.data()), hills.size() * sizeof(float)});
  folder.write("run.sh",
               "set -e\n"
               "g.region n=5263600 s=5260000 e=503600 w=500000 rows=120 cols=120\n"
               "r.in.bin -f input=z.bin output=z bytes=4 north=5263600 south=5260000 east=503600 "
               "west=500000 rows=120 cols=120\n"
               "r.slope.aspect elevation=z slope=slope aspect=aspect\n"
               "sum=0\n"
               "for day in 15 45 75 105 135 166 197 228 258 288 319 349; do\n"
               "  r.sun elevation=z slope=slope aspect=aspect linke_value=3 beam_rad=b$day "
               "day=$day step=0.25\n"
               "  sum=\"$sum+b$day\"\n"
               "done\n"
               "r.mapcalc expression=\"total=float($sum)\"\n"
               "r.out.bin -f input=total output=all.bin bytes=4 null=-9999\n");
  const std::string command =
      "cd '" + folder.path() +
      "' && grass --tmp-location EPSG:32632 --exec bash run.sh > log.txt 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << test::read_bytes(folder / "log.txt");
  const std::string bytes = test::read_bytes(folder / "all.bin");
  ASSERT_EQ(bytes.size(), hills.size() * sizeof(float));
  Grid<float> theirs(size, size);
  std::copy_n(bytes.data(), bytes.size(), reinterpret_cast<char*>(theirs.data()));
  const MapPosition position = make_map_position(
      {.origin_x = 500000.0, .origin_y = 5263600.0, .cell_x = 30.0, .cell_y = 30.0},
      normalize_crs("EPSG:32632"), size, size, {});
  RadiationParameters parameters;
  parameters.sun.transmissivity = 0.77;  // about Linke 3
  const Radiation ours = potential_radiation(hills, position, parameters);
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (int y = 3; y < size - 3; ++y)
    for (int x = 3; x < size - 3; ++x) {
      const double p = theirs(x, y);
      const double q = ours.direct_mj_m2(x, y);
      n += 1, a += p, b += q, aa += p * p, bb += q * q, ab += p * q;
    }
  const double r = (ab - a * b / n) / std::sqrt((aa - a * a / n) * (bb - b * b / n));
  RecordProperty("r", std::to_string(r));
  EXPECT_GT(r, 0.995);
  // Wh on twelve days, each for a month; r.sun uses another air mass.
  EXPECT_NEAR(a / n * 3600e-6 * 365.0 / 12.0, b / n, 0.05 * b / n);
}

using testing::HasSubstr;

double level_mj(double latitude_deg, const SunYearParameters& parameters) {
  double sum = 0.0;
  for (const SunMoment& sun : sun_moments(latitude_deg, parameters))
    sum += sun.exposure_mj * sun.sine;
  return sum;
}

TEST(SunYear, ADayAboveTheAirIsTheTextbooks) {
  // Duffie & Beckman's formula H0 = 24/π G E0 (cos φ cos δ sin ωs + ωs sin φ sin δ); 42° N, 21
  // June: 11.6 kWh.
  for (const int day : {15, 80, 172, 300})
    for (const double latitude : {-50.0, 0.0, 42.0, 60.0}) {
      const SunOfDay sun = sun_of_day(day);
      const double phi = to_radians(latitude);
      const double set = std::acos(-std::tan(phi) * std::tan(sun.declination_rad));
      const double expected = 24.0 / std::numbers::pi * 3600e-6 * 1367.0 * sun.nearness *
                              (std::cos(phi) * std::cos(sun.declination_rad) * std::sin(set) +
                               set * std::sin(phi) * std::sin(sun.declination_rad));
      EXPECT_NEAR(level_mj(latitude, {.first_day = day, .last_day = day}), expected,
                  2e-4 * expected)
          << day << ' ' << latitude;
    }
  EXPECT_NEAR(level_mj(42.0, {.first_day = 172, .last_day = 172}) / 3.6, 11.647, 0.03);
}

TEST(SunYear, SpansOfDaysAddUpAndRunOverTheNewYear) {
  const double year = level_mj(47.0, {});
  const double summer = level_mj(47.0, {.first_day = 100, .last_day = 280});
  const double winter = level_mj(47.0, {.first_day = 281, .last_day = 99});
  EXPECT_NEAR(summer + winter, year, 1e-9 * year);
  EXPECT_GT(summer, 2.0 * winter);
}

TEST(SunYear, MorningsAreInTheEastNoonsInTheSouthAndTheAirIsThickAtTheHorizon) {
  for (const SunMoment& sun :
       sun_moments(47.0, {.first_day = 80, .last_day = 80, .step_min = 10.0})) {
    if (sun.sine < 0.05) {
      EXPECT_GT(sun.air_mass, 12.0);
    } else if (sun.sine > 0.68) {
      EXPECT_NEAR(to_degrees(sun.azimuth_rad), 180.0, 5.0);
    }
    EXPECT_NEAR(sun.sine * sun.sine + sun.cosine * sun.cosine, 1.0, 1e-12);
  }
  EXPECT_LT(to_degrees(sun_moments(47.0, {.first_day = 80, .last_day = 80}).front().azimuth_rad),
            95.0);
  EXPECT_TRUE(sun_moments(80.0, {.first_day = 355, .last_day = 355}).empty()) << "polar night";
}

TEST(SunYear, ClearAirLetsMoreThroughHigherUp) {
  EXPECT_NEAR(clear_share(0.75, 1.0, 0.0), 0.75, 1e-12);
  EXPECT_NEAR(clear_share(0.75, 2.0, 0.0), 0.5625, 1e-12);
  EXPECT_NEAR(clear_share(0.75, 1.0, 8434.5), std::pow(0.75, std::exp(-1.0)), 1e-12);
}

TEST(SunYear, TheTableHoldsWhatTheSunSendsFromAboveATangent) {
  const SunYearParameters parameters{.step_min = 10.0};
  constexpr int sectors = 16;
  const SunTable table(46.0, 46.0, 0.0, 2000.0, 0.0, sectors, parameters);
  ASSERT_EQ(table.latitudes(), 1);
  for (const float tangent : {0.0F, 0.2F, 0.7F}) {
    double sum = 0.0;
    for (int s = 0; s < sectors; ++s)
      sum +=
          static_cast<double>(table.sums(s)[SunTable::step_of(tangent) * SunTable::altitudes * 4]);
    double expected = 0.0;
    for (const SunMoment& sun : sun_moments(46.0, parameters))
      if (sun.sine > static_cast<double>(tangent) * sun.cosine)
        expected +=
            sun.exposure_mj * sun.sine * clear_share(parameters.transmissivity, sun.air_mass, 0.0);
    EXPECT_NEAR(sum, expected, 1e-3 * expected) << tangent;
  }
  EXPECT_FALSE(table.lit(0)) << "no sun in the north";
  EXPECT_TRUE(table.lit(sectors / 2));
}

TEST(SunYear, WhatIsOutOfRangeIsNamed) {
  EXPECT_THAT(test::message_of(ErrorKind::usage, [] { sun_moments(47.0, {.first_day = 0}); }),
              HasSubstr("first_day"));
  EXPECT_THAT(
      test::message_of(ErrorKind::usage, [] { sun_moments(47.0, {.transmissivity = 1.5}); }),
      HasSubstr("transmissivity"));
  EXPECT_THAT(test::message_of(ErrorKind::usage, [] { sun_moments(91.0, {}); }),
              HasSubstr("latitude"));
}

}  // namespace

}  // namespace belvedere
