#include "terrain/climate/climate.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// A ridge across the map, 300 m cells.
Dem make_ridge(int width, int height) {
  Raster<float> raster;
  raster.cells = Grid<float>(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      raster.cells(x, y) = static_cast<float>(
          500.0 + 1500.0 * std::exp(-0.5 * std::pow((x - 0.5 * width) * 0.3 / 6.0, 2.0)));
  raster.transform = {
      .origin_x = 600000.0, .origin_y = 5250000.0, .cell_x = 300.0, .cell_y = 300.0};
  raster.crs = normalize_crs("EPSG:32632");
  return make_dem(std::move(raster));
}

// Colder northwards by .7 K per degree, 5 … 6.5 K/km, 800 mm and 100 mm/km.
PlaceClimate synthetic(glm::dvec2 lonlat) {
  PlaceClimate column;
  for (std::size_t m = 0; m < 12; ++m) {
    column.sea_level_c[m] = 12.0 - 0.7 * (lonlat.y - 47.0) + (m >= 5 && m <= 7 ? 8.0 : 0.0);
    column.lapse_k_per_km[m] = m >= 5 && m <= 7 ? 6.5 : 5.0;
  }
  for (std::size_t km = 0; km < 8; ++km)
    column.rain_mm_at_km[km] = 800.0 + 100.0 * static_cast<double>(km);
  return column;
}

RasterSource source_of(const std::string& path) {
  RasterSource source;
  source.path = path;
  return source;
}

std::string join(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

TEST(Climate, WithoutSourcesItIsTheDefaultAtEachPlace) {
  const Dem dem = make_ridge(60, 400);
  const Climate climate =
      make_climate(dem, {.upslope = {.strength = 0.0}}, synthetic, silent_progress());
  for (const int row : {0, 170, 399}) {
    const double latitude = climate.position.latitude_deg.at(30, row);
    const PlaceClimate column = climate.at(30, row);
    EXPECT_NEAR(monthly_c(column, 2000.0)[0], 12.0 - 0.7 * (latitude - 47.0) - 10.0, 1e-3);
    EXPECT_NEAR(monthly_c(column, 2000.0)[6], 20.0 - 0.7 * (latitude - 47.0) - 13.0, 1e-3);
    EXPECT_NEAR(rain_mm(column, 2500.0), 1050.0, 1e-9);
    EXPECT_NEAR(rain_mm(column, -100.0), 800.0, 1e-9);
    EXPECT_NEAR(rain_mm(column, 9000.0), 1500.0, 1e-9);
    EXPECT_NEAR(column.summer_share, 0.5, 1e-12);
  }
  EXPECT_THAT(join(climate.sources),
              AllOf(HasSubstr("temperature: from latitude"), HasSubstr("rain: from latitude")));
}

TEST(Climate, WindSharesRainOutOnLargeMapsOrWhereItIsAskedFor) {
  // 60 km wide: westerlies by default.
  const Climate large = make_climate(make_ridge(200, 60), {}, synthetic, silent_progress());
  EXPECT_EQ(large.wind_from_deg, 270.0);
  EXPECT_GT(rain_mm(large.at(80, 30), 1000.0), 1.2 * rain_mm(large.at(120, 30), 1000.0));
  const Climate turned =
      make_climate(make_ridge(200, 60), {.wind_from_deg = 90.0}, synthetic, silent_progress());
  EXPECT_LT(1.2 * rain_mm(turned.at(80, 30), 1000.0), rain_mm(turned.at(120, 30), 1000.0));
  const Climate small = make_climate(make_ridge(60, 60), {}, synthetic, silent_progress());
  EXPECT_TRUE(small.rain_share.empty());
  EXPECT_FALSE(
      make_climate(make_ridge(60, 60), {.wind_from_deg = 200.0}, synthetic, silent_progress())
          .rain_share.empty());
  EXPECT_EQ(usual_wind_from_deg(-3.0), 90.0);
  EXPECT_EQ(usual_wind_from_deg(-45.0), 270.0);
}

// Stations over the ridge of make_ridge, with the rain of `rain(position, altitude, share)`, where
// share is what a wind from the west brings by itself.
template <class Rain>
std::vector<Station> stations_on(const Dem& dem, Rain&& rain) {
  const Climate windy = make_climate(
      dem, {.wind_from_deg = 270.0},
      [](glm::dvec2) {
        PlaceClimate even;
        even.rain_mm_at_km.fill(1000.0);
        return even;
      },
      silent_progress());
  std::vector<Station> stations;
  for (int i = 0; i < 24; ++i) {
    const int x = (2 * i + 1) * dem.width() / 48;
    const int y = (7 * i + 3) % dem.height();
    Station station;
    station.position = dem.transform.to_crs(x, y);
    station.altitude_m = static_cast<double>(dem.altitude_m(x, y));
    station.rain_mm = rain(station.position, station.altitude_m,
                           rain_mm(windy.at(x, y), station.altitude_m) / 1000.0);
    stations.push_back(station);
  }
  return stations;
}

// Rain of stations is met where they stand, whether they know a lee or not, on maps of any size.
TEST(Climate, RainIsMetAtItsStationsOnMapsOfAnySize) {
  const test::Folder folder;
  for (const int km : {12, 40, 80}) {
    const Dem dem = make_ridge(km * 1000 / 300, 60);
    for (const bool lee : {false, true}) {
      SCOPED_TRACE(testing::Message() << km << " km" << (lee ? ", with a lee" : ""));
      const std::vector<Station> stations = stations_on(dem, [&](glm::dvec2 position,
                                                                 double altitude_m, double share) {
        return (900.0 + 0.1 * altitude_m + 2e-3 * (position.x - 600000.0)) * (lee ? share : 1.0);
      });
      std::string text = "east,north,altitude,rain_mm\n";
      for (const Station& station : stations)
        text += fmt::format("{},{},{},{}\n", station.position.x, station.position.y,
                            station.altitude_m, station.rain_mm);
      const Climate climate = make_climate(dem, {.stations = folder.write("s.csv", text)},
                                           synthetic, silent_progress());
      for (const Station& station : stations) {
        const glm::dvec2 cell = dem.transform.to_cell(station.position.x, station.position.y);
        ASSERT_NEAR(rain_mm(climate.at(cell.x, cell.y), station.altitude_m), station.rain_mm, 2.0)
            << cell.x << ' ' << cell.y;
      }
      EXPECT_EQ(climate.rain_share.empty(), !lee);
      EXPECT_THAT(join(climate.sources),
                  HasSubstr(lee ? "in the lee of a wind" : "show no windward and lee"));
      // A wind that the scene names acts in any case.
      EXPECT_FALSE(make_climate(dem, {.stations = folder / "s.csv", .wind_from_deg = 270.0},
                                synthetic, silent_progress())
                       .rain_share.empty());
    }
  }
}

// The printed error is that of the rain that falls in the end, after the wind: each station left
// out of the file in turn and looked up in the climate of the others.
TEST(Climate, PrintedErrorOfRainIsThatOfTheRainThatFalls) {
  const test::Folder folder;
  const std::string words = "error at a left-out station ";
  for (const int km : {12, 40, 80}) {
    const Dem dem = make_ridge(km * 1000 / 300, 60);
    std::vector<Station> stations;  // ten, on both sides of the ridge
    int number = 0;
    for (const Station& station :
         stations_on(dem, [](glm::dvec2 position, double altitude_m, double share) {
           const double uneven = std::sin(0.37 * position.x) + std::cos(0.53 * position.y);
           return (900.0 + 0.1 * altitude_m + 150.0 * uneven) * share;
         }))
      if (number++ % 2 == 0 && stations.size() < 10) stations.push_back(station);
    const auto climate_without = [&](std::size_t left_out) {
      std::string text = "east,north,altitude,rain_mm\n";
      for (std::size_t i = 0; i < stations.size(); ++i)
        if (i != left_out)
          text += fmt::format("{},{},{},{}\n", stations[i].position.x, stations[i].position.y,
                              stations[i].altitude_m, stations[i].rain_mm);
      return make_climate(dem, {.stations = folder.write("s.csv", text), .wind_from_deg = 270.0},
                          synthetic, silent_progress());
    };
    double square = 0.0;
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const glm::dvec2 cell = dem.transform.to_cell(stations[i].position.x, stations[i].position.y);
      square += std::pow(rain_mm(climate_without(i).at(cell.x, cell.y), stations[i].altitude_m) -
                             stations[i].rain_mm,
                         2.0);
    }
    const std::string told = join(climate_without(stations.size()).sources);
    const std::size_t at = told.find(words);
    ASSERT_NE(at, std::string::npos) << told;
    EXPECT_NEAR(std::stod(told.substr(at + words.size())),
                std::sqrt(square / static_cast<double>(stations.size())), 1.0)
        << km << " km";
  }
}

// P14, P46: stations of two regions, 80 km apart at most, each with its own rate of temperature and
// its own rain; with half a degree and 30 mm of noise.
TEST(Climate, RegionsHaveTheirOwnRatesAndBlendBetween) {
  const Dem dem = make_ridge(267, 60);
  const test::Folder folder;
  std::string text = "east,north,altitude,t_year,rain_mm,region\n";
  std::string one_region = "east,north,altitude,t_year,rain_mm\n";
  for (int i = 0; i < 40; ++i) {
    const bool west = i < 20;
    const double east_m = 600000.0 + (west ? 1000.0 : 59000.0) + 20000.0 * ((7 * i) % 20) / 20.0;
    const double north_m = 5233000.0 + 16000.0 * (i % 20) / 20.0;
    const double altitude_m = 400.0 + 1800.0 * ((11 * i) % 20) / 20.0;
    const double noise = std::sin(2.7 * i) * std::cos(1.3 * i * i);
    const double year_c =
        (west ? 12.0 - 4e-3 * altitude_m : 15.0 - 7e-3 * altitude_m) + 0.5 * noise;
    const double rain =
        (west ? 600.0 + 0.3 * altitude_m : 1500.0 + 0.05 * altitude_m) + 30.0 * noise;
    const std::string row =
        fmt::format("{},{},{},{},{}", east_m, north_m, altitude_m, year_c, rain);
    text += row + (west ? ",west\n" : ",east\n");
    one_region += row + "\n";
  }
  const Climate climate =
      make_climate(dem, {.stations = folder.write("s.csv", text), .upslope = {.strength = 0.0}},
                   synthetic, silent_progress());
  const auto lapse = [](const PlaceClimate& column) {
    double sum = 0.0;
    for (const double month : column.lapse_k_per_km) sum += month / 12.0;
    return sum;
  };
  const PlaceClimate west = climate.at(35, 30);
  const PlaceClimate east = climate.at(230, 30);
  EXPECT_NEAR(lapse(west), 4.0, 0.25);
  EXPECT_NEAR(lapse(east), 7.0, 0.25);
  EXPECT_NEAR(rain_mm(west, 2000.0) - rain_mm(west, 1000.0), 300.0, 40.0);
  EXPECT_NEAR(rain_mm(east, 2000.0) - rain_mm(east, 1000.0), 50.0, 40.0);
  EXPECT_NEAR(rain_mm(west, 1000.0), 900.0, 60.0);
  EXPECT_NEAR(rain_mm(east, 1000.0), 1550.0, 60.0);
  // Between them without a step: 2 K and 650 mm over some 20 km, cells of 300 m.
  for (int x = 1; x < dem.width(); ++x) {
    const PlaceClimate a = climate.at(x - 1, 30);
    const PlaceClimate b = climate.at(x, 30);
    EXPECT_LT(std::abs(monthly_c(b, 2000.0)[6] - monthly_c(a, 2000.0)[6]), 0.2) << x;
    EXPECT_LT(std::abs(rain_mm(b, 1000.0) - rain_mm(a, 1000.0)), 40.0) << x;
  }
  EXPECT_THAT(join(climate.sources),
              AllOf(HasSubstr("region \"west\": 20 stations"), HasSubstr("region \"east\"")));
  // Without the column both get one rate between.
  const PlaceClimate mixed = make_climate(dem, {.stations = folder.write("m.csv", one_region)},
                                          synthetic, silent_progress())
                                 .at(35, 30);
  EXPECT_GT(lapse(mixed), 4.5);
  EXPECT_LT(lapse(mixed), 6.5);
}

// The rain of dry places was measured in the lee of their ranges.
TEST(Climate, DryPlacesKeepTheirRainOnMapsOfAnySize) {
  const auto dry = [](glm::dvec2 lonlat) {
    PlaceClimate place = synthetic(lonlat);
    place.sheltered = 1.0;
    return place;
  };
  for (const int km : {12, 40, 80})
    for (const std::optional<double> wind : {std::optional<double>(), std::optional(270.0)}) {
      const Dem dem = make_ridge(km * 1000 / 300, 60);
      const Climate climate = make_climate(dem, {.wind_from_deg = wind}, dry, silent_progress());
      for (int x = 0; x < dem.width(); ++x)
        ASSERT_NEAR(rain_mm(climate.at(x, 30), 1000.0), 900.0, 1e-3) << km << " km, " << x;
    }
  // Half as much table, half as much wind.
  const Dem dem = make_ridge(200, 60);
  const auto half = [](glm::dvec2 lonlat) {
    PlaceClimate place = synthetic(lonlat);
    place.sheltered = 0.5;
    return place;
  };
  const Climate open = make_climate(dem, {}, synthetic, silent_progress());
  const Climate between = make_climate(dem, {}, half, silent_progress());
  for (int x = 10; x < 190; x += 10)
    EXPECT_NEAR(rain_mm(between.at(x, 30), 1000.0), 0.5 * (900.0 + rain_mm(open.at(x, 30), 1000.0)),
                0.1)
        << x;
}

// Dry country that the tables do not know: the scene says so, and the wind does not dry it twice.
TEST(Climate, ShelteredGroundHasTheRainOfTheDryPlacesAround) {
  const Dem dem = make_ridge(200, 60);
  const Climate climate = make_climate(dem, {.sheltered = 1.0}, synthetic, silent_progress());
  const double mm = rain_mm(climate.at(100, 30), 1000.0);
  EXPECT_LT(mm, 600.0);
  EXPECT_GT(climate.at(100, 30).dry_air, 0.0);
  for (const int x : {20, 80, 120, 180})
    EXPECT_NEAR(rain_mm(climate.at(x, 30), 1000.0), mm, 0.1 * mm) << x;
}

TEST(Climate, ARasterOfMonthsIsMetAtItsOwnAltitudes) {
  // A raster with the exact values of another climate on this ground: 6 K/km, in tenths of a
  // kelvin.
  const Dem dem = make_ridge(100, 30);
  const test::Folder folder;
  Raster<float> month{Grid<float>(100, 30), dem.transform, dem.crs};
  for (std::size_t i = 0; i < month.cells.size(); ++i)
    month.cells[i] = 10.0F * (273.15F + 15.0F - 6e-3F * dem.altitude_m[i]);
  write_raster(folder / "month.tif", month);
  std::string vrt =
      "<VRTDataset rasterXSize=\"100\" "
      "rasterYSize=\"30\"><SRS>EPSG:32632</SRS><GeoTransform>600000,300,0,5250000,0,-300</"
      "GeoTransform>";
  for (int band = 1; band <= 12; ++band)
    vrt += "<VRTRasterBand dataType=\"Float32\" band=\"" + std::to_string(band) +
           "\"><SimpleSource><SourceFilename "
           "relativeToVRT=\"1\">month.tif</SourceFilename><SourceBand>1</SourceBand></"
           "SimpleSource></VRTRasterBand>";
  ClimateParameters parameters;
  parameters.temperature = source_of(folder.write("months.vrt", vrt + "</VRTDataset>"));
  parameters.temperature_factor = 0.1;
  const Climate climate = make_climate(dem, parameters, synthetic, silent_progress());
  for (int y = 5; y < 25; y += 4)
    for (int x = 5; x < 95; x += 6) {
      const PlaceClimate column = climate.at(x, y);
      EXPECT_NEAR(monthly_c(column, dem.altitude_m(x, y))[3], 15.0 - 6e-3 * dem.altitude_m(x, y),
                  0.15)
          << x << ' ' << y;
      EXPECT_NEAR(column.lapse_k_per_km[3], 6.0, 0.1);
    }
  EXPECT_THAT(join(climate.sources), HasSubstr("in kelvin"));
  parameters.temperature = source_of(folder / "month.tif");
  EXPECT_THAT(
      test::message_of(ErrorKind::usage,
                       [&] { make_climate(dem, parameters, synthetic, silent_progress()); }),
      HasSubstr("12 bands, the means"));
  // Annual rain in one band.
  for (float& value : month.cells) value = 640.0F;
  write_raster(folder / "rain.tif", month);
  const Climate wet =
      make_climate(dem, {.rain = source_of(folder / "rain.tif")}, synthetic, silent_progress());
  EXPECT_NEAR(rain_mm(wet.at(20, 15), dem.altitude_m(20, 15)), 640.0, 5.0);
  // It shows the lee already, also of a wind that the scene names.
  const Climate windy =
      make_climate(dem, {.rain = source_of(folder / "rain.tif"), .wind_from_deg = 270.0}, synthetic,
                   silent_progress());
  for (const int x : {20, 40, 60, 80})
    EXPECT_NEAR(rain_mm(windy.at(x, 15), dem.altitude_m(x, 15)), 640.0, 5.0) << x;
}

TEST(Climate, StationsHaveTheFirstWordAndTellHowSureTheyAre) {
  const std::string folder = test::data_folder() + "/oetztal/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs " << folder;
  DemParameters where;
  where.sources = {source_of(folder + "srtm_oetztal.tif")};
  const Dem dem = read_dem(where, silent_progress());
  const Climate climate =
      make_climate(dem, {.stations = folder + "HISTALP_oetztal.nc"}, synthetic, silent_progress());
  EXPECT_THAT(join(climate.sources),
              AllOf(HasSubstr("falls 5.74 K/km"), HasSubstr("5.5"), HasSubstr("resampled stations"),
                    HasSubstr("mm per km of altitude"), HasSubstr("wind from 270°")));
  const PlaceClimate centre = climate.at(0.5 * dem.width(), 0.5 * dem.height());
  double year = 0.0;
  for (std::size_t m = 0; m < 12; ++m) year += monthly_c(centre, 1938.0)[m] / 12.0;
  EXPECT_NEAR(year, 2.4, 1.0) << "Obergurgl, 1938 m, has 2.6 °C";
  EXPECT_NEAR(rain_mm(centre, 1938.0), 900.0, 350.0);
}

// The correction by measured glaciers applies only to the default's rain: with rain from stations,
// hollows collect the usual amount.
TEST(Climate, HollowsGatherWhatIsUsualWhereRainIsKnown) {
  const test::Folder folder;
  std::string with_rain = "east,north,altitude,t_year,rain_mm\n";
  std::string without = "east,north,altitude,t_year\n";
  for (int i = 0; i < 9; ++i) {
    const std::string position = "610000,5240000," + std::to_string(400 + 250 * i) + "," +
                                 std::to_string(9.0 - 0.006 * 250 * i);
    with_rain += position + "," + std::to_string(900 + 20 * i) + "\n";
    without += position + "\n";
  }
  const auto scarce = [](glm::dvec2 lonlat) {
    PlaceClimate position = synthetic(lonlat);
    position.gathers = 0.6;
    return position;
  };
  const Dem dem = make_ridge(60, 60);
  const auto gathers = [&](const std::string& file) {
    ClimateParameters parameters;
    parameters.stations = file;
    return make_climate(dem, parameters, scarce, silent_progress()).at(30, 30).gathers;
  };
  EXPECT_NEAR(gathers(folder.write("rain.csv", with_rain)), 1.0, 1e-12);
  EXPECT_NEAR(gathers(folder.write("dry.csv", without)), 0.6, 1e-12);
  EXPECT_NEAR(gathers(""), 0.6, 1e-12);
}

TEST(Climate, MeansOfTheYearTakeTheirCourseFromTheDefaultAndTheSceneHasTheLastWordOnTheLapse) {
  const test::Folder folder;
  std::string text = "east,north,altitude,t_year\n";
  for (int i = 0; i < 9; ++i)
    text += "610000,5240000," + std::to_string(400 + 250 * i) + "," +
            std::to_string(9.0 - 0.006 * 250 * i) + "\n";
  ClimateParameters parameters;
  parameters.stations = folder.write("s.csv", text);
  const Dem dem = make_ridge(60, 60);
  const PlaceClimate column =
      make_climate(dem, parameters, synthetic, silent_progress()).at(30, 30);
  double year = 0.0;
  double lapse = 0.0;
  for (std::size_t m = 0; m < 12; ++m) {
    year += monthly_c(column, 1400.0)[m] / 12.0;
    lapse += column.lapse_k_per_km[m] / 12.0;
  }
  EXPECT_NEAR(year, 3.0, 1e-6);
  EXPECT_NEAR(lapse, 6.0, 1e-6);
  EXPECT_NEAR(column.sea_level_c[6] - column.sea_level_c[0], 8.0, 1e-9);
  parameters.lapse_k_per_km = 4.0;
  const PlaceClimate said = make_climate(dem, parameters, synthetic, silent_progress()).at(30, 30);
  EXPECT_EQ(said.lapse_k_per_km[0], 4.0);
  parameters.lapse_k_per_km = 40.0;
  EXPECT_THAT(
      test::message_of(ErrorKind::usage,
                       [&] { make_climate(dem, parameters, synthetic, silent_progress()); }),
      HasSubstr("lapse_k_per_km"));
}

}  // namespace
}  // namespace belvedere
