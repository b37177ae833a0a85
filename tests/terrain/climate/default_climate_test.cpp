#include "terrain/climate/default_climate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/math.h"
#include "terrain/climate/water_balance.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

const ClimateField& built_in_field() {
  static const ClimateField field = make_climate_field(read_climate_stations());
  return field;
}

double km_between(const MeasuredGlacier& a, const MeasuredGlacier& b) {
  const double north = (a.latitude_deg - b.latitude_deg) * 111.2;
  const double east =
      (a.longitude_deg - b.longitude_deg) * 111.2 * std::cos(to_radians(a.latitude_deg));
  return std::hypot(north, east);
}

// Errors of equilibrium lines predicted from all glaciers farther than that from each, m.
struct GlacierMisses {
  double rms = 0.0;
  double mean = 0.0;
  double alps_rms = 0.0;
};
GlacierMisses misses_without_glaciers_within(double km, const GlacierSimilarity& similarity = {}) {
  const std::vector<MeasuredGlacier> all = read_measured_glaciers();
  // The equilibrium line of a measured glacier depends only on its position.
  const SnowGathering whole = make_snow_gathering(built_in_field(), all, similarity);
  GlacierMisses misses;
  int alps = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    SnowGathering others{similarity, {}, {}};
    for (std::size_t k = 0; k < all.size(); ++k)
      if (k != i && km_between(all[i], all[k]) > km) {
        others.positions.push_back(whole.positions[k]);
        others.log_gathers.push_back(whole.log_gathers[k]);
      }
    PlaceClimate position =
        place_climate(built_in_field(), all[i].longitude_deg, all[i].latitude_deg);
    position.gathers = gathers_at(others, all[i].longitude_deg, all[i].latitude_deg);
    const double miss = snow_line_m(position) - all[i].equilibrium_m;
    misses.rms += miss * miss;
    misses.mean += miss;
    if (all[i].latitude_deg > 45.0 && all[i].latitude_deg < 47.5 && all[i].longitude_deg > 5.0 &&
        all[i].longitude_deg < 14.0) {
      misses.alps_rms += miss * miss;
      ++alps;
    }
  }
  const auto n = static_cast<double>(all.size());
  return {std::sqrt(misses.rms / n), misses.mean / n,
          std::sqrt(misses.alps_rms / std::max(1, alps))};
}

TEST(DefaultClimate, GlaciersAreToldByTheOthers) {
  const GlacierMisses misses = misses_without_glaciers_within(0.0);
  EXPECT_LT(misses.rms, 215.0);
  EXPECT_LT(std::abs(misses.mean), 50.0);
  EXPECT_LT(misses.alps_rms, 155.0);
  const GlacierMisses alone = misses_without_glaciers_within(100.0);
  EXPECT_LT(alone.rms, 230.0) << "without those within 100 km";
  EXPECT_LT(alone.alps_rms, 205.0);
  // Without glaciers the lines in the Alps, whose summits have stations, are too low.
  EXPECT_GT(misses_without_glaciers_within(0.0, {.reach_km = 300.0, .usual_weight = 1e9}).alps_rms,
            misses.alps_rms + 100.0);
}

// No line depends on a single nearby station or glacier.
TEST(DefaultClimate, LinesHoldWithoutStationsAndGlaciersNearThem) {
  const std::vector<MeasuredGlacier> all = read_measured_glaciers();
  double square_m = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < all.size(); i += 4, ++count) {
    std::vector<ClimateStation> stations;
    for (const ClimateStation& s : read_climate_stations())
      if (km_between({s.name, s.latitude_deg, s.longitude_deg, 0.0}, all[i]) > 100.0)
        stations.push_back(s);
    std::vector<MeasuredGlacier> glaciers;
    for (const MeasuredGlacier& g : all)
      if (km_between(g, all[i]) > 100.0) glaciers.push_back(g);
    const ClimateField field = make_climate_field(stations);
    PlaceClimate position = place_climate(field, all[i].longitude_deg, all[i].latitude_deg);
    position.gathers =
        gathers_at(make_snow_gathering(field, glaciers), all[i].longitude_deg, all[i].latitude_deg);
    const double miss = snow_line_m(position) - all[i].equilibrium_m;
    square_m += miss * miss;
  }
  RecordProperty("rms", std::to_string(std::sqrt(square_m / count)));
  EXPECT_LT(std::sqrt(square_m / count), 450.0);
}

TEST(DefaultClimate, AGlacierAloneHasItsOwnLine) {
  const MeasuredGlacier glacier{"G", 46.8, 10.8, 3000.0};
  const SnowGathering gathering =
      make_snow_gathering(built_in_field(), {glacier}, {.reach_km = 300.0, .usual_weight = 1e-9});
  PlaceClimate position = place_climate(built_in_field(), 10.8, 46.8);
  position.gathers = gathers_at(gathering, 10.8, 46.8);
  EXPECT_NEAR(snow_line_m(position), 3000.0, 0.1);
  // It affects its neighbours, but nothing on the other side of the Earth.
  const SnowGathering modest = make_snow_gathering(built_in_field(), {glacier});
  EXPECT_GT(std::log(gathers_at(modest, 10.8, 46.8)) / std::log(gathers_at(modest, 14.0, 46.8)),
            1.2);
  EXPECT_NEAR(gathers_at(modest, -169.0, -46.8), 1.0, 1e-3);
  EXPECT_NEAR(gathers_at({}, 10.8, 46.8), 1.0, 1e-12);
}

TEST(DefaultClimate, BadGlaciersNameTheirLine) {
  const auto message_of = [](const std::string& text) {
    try {
      measured_glaciers_from_toml(text, "g.toml");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(message_of("version = 1\nglaciers = [\n[\"A\", 95.0, 0, 3000, \"W\"]]"),
              HasSubstr("g.toml:3"));
  EXPECT_THAT(message_of("version = 1\nglaciers = [\n[\"A\", 45.0, 0]]"), HasSubstr("g.toml:3"));
  EXPECT_THAT(message_of("version = 2\nglaciers = []"), HasSubstr("version = 1"));
}

// 800 mm everywhere, 10 °C at 0 m.
PlaceClimate mild() {
  PlaceClimate climate;
  climate.sea_level_c.fill(10.0);
  climate.lapse_k_per_km.fill(5.0);
  climate.rain_mm_at_km.fill(800.0);
  return climate;
}

DryPlace basin(double longitude_deg) {
  return {.name = "B",
          .latitude_deg = 0.0,
          .longitude_deg = longitude_deg,
          .radius_km = 100.0,
          .floor_m = 1000.0,
          .wet_from_m = 3000.0,
          .rain_mm = 200.0,
          .evaporation_mm = 900.0};
}

TEST(DryPlaces, TheFloorHasItsRainAndEvaporationAndTheCrestsKeepTheirRain) {
  const PlaceClimate dried = dried_climate(make_dry_country({basin(10.0)}), mild(), 10.2, 0.1);
  EXPECT_NEAR(rain_mm(dried, 0.0), 200.0, 1e-9);
  EXPECT_NEAR(rain_mm(dried, 1000.0), 200.0, 1e-9);
  EXPECT_NEAR(rain_mm(dried, 2000.0), 400.0, 1e-9);  // half of the logarithm
  EXPECT_EQ(rain_mm(dried, 3000.0), 800.0);
  EXPECT_NEAR(plant_water_demand_mm(dried, 1000.0), 900.0, 1e-9);
  EXPECT_NEAR(plant_water_share(dried, 1000.0), 200.0 / 900.0, 1e-9);
}

TEST(DryPlaces, BeyondTheRadiusNothingChanges) {
  const DryCountry country = make_dry_country({basin(10.0)});
  const PlaceClimate beyond = dried_climate(country, mild(), 10.91, 0.0);
  EXPECT_EQ(beyond.rain_mm_at_km, mild().rain_mm_at_km);
  EXPECT_EQ(beyond.dry_air, 0.0);
  EXPECT_EQ(beyond.sheltered, 0.0);
  EXPECT_EQ(dried_climate(country, mild(), 10.2, 0.0).sheltered, 1.0);
  const PlaceClimate near = dried_climate(country, mild(), 10.8, 0.0);
  EXPECT_LT(near.rain_mm_at_km[0], 800.0);
  EXPECT_GT(near.rain_mm_at_km[0], 600.0);
}

TEST(DryPlaces, WhereTwoOverlapTheirMeanHolds) {
  DryPlace drier = basin(10.0);
  drier.rain_mm = 50.0;
  const PlaceClimate both =
      dried_climate(make_dry_country({basin(10.0), drier}), mild(), 10.0, 0.0);
  EXPECT_NEAR(rain_mm(both, 500.0), 100.0, 1e-9);  // the geometric mean
  EXPECT_NEAR(plant_water_demand_mm(both, 1000.0), 900.0, 1e-9);
}

TEST(DryPlaces, NeverMakeAPlaceWetter) {
  DryPlace wet = basin(10.0);
  wet.rain_mm = 600.0;
  PlaceClimate desert = mild();
  desert.rain_mm_at_km.fill(100.0);
  const PlaceClimate dried = dried_climate(make_dry_country({wet}), desert, 10.0, 0.0);
  EXPECT_EQ(dried.rain_mm_at_km, desert.rain_mm_at_km);
}

TEST(DryPlaces, TheWetSidesOfRangesAreBeyondAllOfThem) {
  const std::vector<std::pair<double, double>> places = {
      {11.4, 47.3},   {7.9, 46.3},    {6.6, 44.9},    {11.9, 46.4},   {7.4, 43.9},    {15.5, 47.5},
      {138.7, 35.4},  {83.9, 28.5},   {84.5, 28.6},   {85.5, 28.3},   {86.9, 28.1},   {81.5, 29.2},
      {170.1, -43.6}, {168.7, -45.0}, {169.4, -45.2}, {175.6, -39.3}, {-121.8, 46.9}, {7.0, 61.5}};
  for (const auto& [longitude, latitude] : places)
    EXPECT_EQ(default_climate(longitude, latitude).dry_air, 0.0) << longitude << ' ' << latitude;
}

TEST(DryPlaces, TheBuiltInOnesAreDry) {
  const std::vector<DryPlace> places = read_dry_places();
  EXPECT_GT(places.size(), 100U);
  for (const DryPlace& place : places) {
    EXPECT_LT(place.rain_mm / place.evaporation_mm, 0.5) << place.name;  // UNEP: semi-arid
    EXPECT_GT(default_climate(place.longitude_deg, place.latitude_deg).dry_air, 0.04) << place.name;
  }
}

// Each row by the rest, without those that reach it: rain to a factor of two, over a range of one
// to a hundred.
TEST(DryField, RowsAreToldByTheOthers) {
  const std::vector<DryPlace> all = read_dry_places();
  const std::vector<ClimateStation> stations = read_climate_stations();
  double square_log = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < all.size(); i += 3, ++count) {
    std::vector<DryPlace> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    PlaceClimate wet = mild();
    wet.rain_mm_at_km.fill(3000.0);
    const PlaceClimate told =
        sheltered_climate(make_dry_field(others, stations), wet, all[i].longitude_deg,
                          all[i].latitude_deg, all[i].floor_m, 1.0);
    square_log +=
        square(std::log((rain_mm(told, all[i].floor_m) + 10.0) / (all[i].rain_mm + 10.0)));
  }
  RecordProperty("rms", std::to_string(std::sqrt(square_log / count)));
  EXPECT_LT(std::sqrt(square_log / count), std::log(2.0));
}

TEST(DryField, ShelterOfNoneChangesNothingAndHalfIsBetween) {
  const PlaceClimate none = sheltered_climate(built_in_dry_field(), mild(), 77.6, 34.1, 500.0, 0.0);
  EXPECT_EQ(none.rain_mm_at_km, mild().rain_mm_at_km);
  EXPECT_EQ(none.dry_air, 0.0);
  const PlaceClimate half = sheltered_climate(built_in_dry_field(), mild(), 77.6, 34.1, 500.0, 0.5);
  const PlaceClimate all = sheltered_climate(built_in_dry_field(), mild(), 77.6, 34.1, 500.0, 1.0);
  EXPECT_NEAR(rain_mm(all, 3000.0), 110.0, 40.0) << "Ladakh";
  EXPECT_NEAR(rain_mm(half, 3000.0), std::sqrt(800.0 * rain_mm(all, 3000.0)), 1e-6);
  EXPECT_NEAR(half.dry_air, 0.5 * all.dry_air, 1e-12);
  EXPECT_EQ(half.sheltered, 0.5);
  // 7.5 °C at its floor.
  EXPECT_NEAR(plant_water_demand_mm(all, 500.0), 970.0 + 39.0 * 7.5, 1.0);
  // Ground drier than its neighbours stays as dry.
  PlaceClimate desert = mild();
  desert.rain_mm_at_km.fill(20.0);
  EXPECT_EQ(sheltered_climate(built_in_dry_field(), desert, 77.6, 34.1, 500.0, 1.0).rain_mm_at_km,
            desert.rain_mm_at_km);
}

TEST(DryPlaces, BadRowsNameTheirLine) {
  const auto message_of = [](const std::string& text) {
    return test::message_of(ErrorKind::usage, [&] { dry_places_from_toml(text, "d.toml"); });
  };
  EXPECT_THAT(message_of("version = 1\nplaces = [\n[\"A\", 45.0, 0]]"), HasSubstr("d.toml:3"));
  EXPECT_THAT(
      message_of("version = 1\nplaces = [\n[\"A\", 45.0, 0, 100, 900, 800, 100, 1000, \"X\"]]"),
      HasSubstr("d.toml:3"));  // wet below its floor
  EXPECT_THAT(message_of("version = 2\nplaces = []"), HasSubstr("version = 1"));
}

}  // namespace

}  // namespace belvedere
