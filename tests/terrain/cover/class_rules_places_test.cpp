#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "terrain/shape/sea.h"
#include "tests/terrain/cover/class_rules_ground.h"
#include "tests/terrain/cover/place_ground.h"

// Land cover at places whose vegetation is known (docs/climate.md, "Dry country").
namespace belvedere {
namespace {

using enum LandCoverClass;
using test::ClassCounts;
using test::count_classes;
using test::cover_at;
using test::ground_at;
using test::MountainPlace;

// By the cover of the ground below the upper third of the relief.
enum class Vegetation { desert, semi_desert, steppe, wooded };

const char* name_of(Vegetation vegetation) {
  constexpr std::array names = {"desert", "semi-desert", "steppe", "wooded"};
  return names[static_cast<std::size_t>(vegetation)];
}

struct Cover {
  double bare = 0.0;   // share of sand, scree and rock
  double trees = 0.0;  // of forest
  double green = 0.0;  // of forest, meadows, fields and settlements
};

Cover low_cover(const MountainPlace& place, const Grid<LandCoverClass>& classes, const Dem& dem) {
  const double limit_m = place.floor_m + 0.6 * (place.top_m - place.floor_m);
  Cover cover;
  double cells = 0.0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (static_cast<double>(dem.altitude_m[i]) > limit_m) continue;
    cells += 1.0;
    const LandCoverClass id = classes[i];
    if (id == sand || id == scree || id == rock) cover.bare += 1.0;
    if (id == forest) cover.trees += 1.0;
    if (id == forest || id == pasture || id == valley_floor || id == settlement) cover.green += 1.0;
  }
  return {cover.bare / cells, cover.trees / cells, cover.green / cells};
}

Cover low_cover(const MountainPlace& place) {
  const Dem dem = ground_at(place);
  return low_cover(place, cover_at(dem), dem);
}

Vegetation vegetation_of(const Cover& cover) {
  if (cover.trees > 0.1 || cover.green > 0.35) return Vegetation::wooded;
  if (cover.bare > 0.75) return Vegetation::desert;
  return cover.bare > 0.4 ? Vegetation::semi_desert : Vegetation::steppe;
}

struct KnownPlace {
  MountainPlace place;
  Vegetation published;
};

// Sources in docs/climate.md.
const std::vector<KnownPlace>& dry_places() {
  using enum Vegetation;
  static const std::vector<KnownPlace> places = {
      {{"Leh", 34.15, 77.57, 3450, 5200}, desert},
      {{"Skardu", 35.30, 75.63, 2230, 4200}, semi_desert},
      {{"Lhasa", 29.65, 91.12, 3650, 5000}, steppe},
      {{"Kashgar", 39.47, 75.98, 1290, 2200}, desert},
      {{"Urumqi", 43.80, 87.62, 900, 1500}, steppe},
      {{"Salt Lake basin", 40.70, -112.60, 1290, 2300}, steppe},
      {{"Death Valley", 36.46, -116.87, -80, 1500}, desert},
      {{"Atacama", -22.90, -68.20, 2400, 3600}, desert},
      {{"Puna", -26.06, -67.40, 3320, 4600}, desert},
      {{"Altiplano", -20.46, -66.82, 3670, 4500}, semi_desert},
      {{"Patagonia", -46.60, -70.90, 400, 1300}, steppe},
      {{"Elburz, south", 35.55, 53.40, 1130, 2300}, semi_desert},
      {{"Atlas, south", 30.92, -6.90, 1140, 2200}, desert},
      {{"Sinai", 28.55, 33.95, 1550, 2400}, desert},
      {{"Mustang", 29.18, 83.95, 3800, 5300}, steppe},
      {{"Pamir", 38.17, 73.97, 3600, 4800}, desert},
      {{"Ararat", 39.80, 44.35, 850, 2600}, semi_desert},
      {{"Gobi Altai", 43.60, 103.70, 1500, 2600}, semi_desert},
      {{"Owens Valley", 36.80, -118.15, 1200, 2400}, semi_desert},
      {{"Tabernas", 37.05, -2.39, 400, 1100}, semi_desert},
  };
  return places;
}

TEST(RulePlaces, AtLeastSixteenOfTwentyDryPlacesGrowWhatIsPublished) {
  int right = 0;
  for (const auto& [place, published] : dry_places()) {
    const Cover cover = low_cover(place);
    const Vegetation found = vegetation_of(cover);
    if (found == published) ++right;
    RecordProperty(place.name,
                   fmt::format("{} ({:.0f} % bare, {:.0f} % trees, {:.0f} % green), published {}",
                               name_of(found), 100.0 * cover.bare, 100.0 * cover.trees,
                               100.0 * cover.green, name_of(published)));
    EXPECT_NE(found, Vegetation::wooded) << place.name;
    EXPECT_LT(cover.trees, 0.06) << place.name;
  }
  RecordProperty("right", right);
  EXPECT_EQ(dry_places().size(), 20U);
  EXPECT_GE(right, 16);
}

// P45: leave-one-out. Without any row of the table that reaches a place, told only that it is dry
// country (climate.sheltered = 1), the other places and the dry stations say how dry.
TEST(RulePlaces, AtLeastFifteenOfTwentyDryPlacesAreToldByTheOthers) {
  const std::vector<DryPlace> all = read_dry_places();
  const std::vector<ClimateStation> stations = read_climate_stations();
  const ClimateField field = make_climate_field(stations);
  int right = 0;
  for (const auto& [place, published] : dry_places()) {
    const auto position = earth_position_km(place.longitude_deg, place.latitude_deg);
    std::vector<DryPlace> others;
    for (const DryPlace& row : all) {
      const double way_km = std::sqrt(
          squared_chord_km2(position, earth_position_km(row.longitude_deg, row.latitude_deg)));
      if (way_km > row.radius_km) others.push_back(row);
    }
    ASSERT_LT(others.size(), all.size()) << place.name;
    const DryField told = make_dry_field(others, stations);
    const Dem dem = ground_at(place);
    const auto sheltered = [&, floor_m = place.floor_m](glm::dvec2 lonlat) {
      return sheltered_climate(told, place_climate(field, lonlat.x, lonlat.y), lonlat.x, lonlat.y,
                               floor_m, 1.0);
    };
    const Cover cover = low_cover(place, cover_at(dem, sheltered), dem);
    const Vegetation found = vegetation_of(cover);
    if (found == published) ++right;
    RecordProperty(place.name, fmt::format("{} ({:.0f} % bare), published {}", name_of(found),
                                           100.0 * cover.bare, name_of(published)));
    if (std::string(place.name) == "Leh") {
      EXPECT_EQ(found, Vegetation::desert) << cover.bare;
    }
    EXPECT_NE(found, Vegetation::wooded) << place.name;
  }
  RecordProperty("right", right);
  EXPECT_GE(right, 15);
}

TEST(RulePlaces, NorthOfTheKarakoramNoFirsStandOnTheFloors) {
  const Cover cover = low_cover({"Shaksgam", 36.10, 76.40, 4000, 5200});
  EXPECT_LT(cover.trees, 0.01);
  EXPECT_LT(cover.green, 0.05);
}

// The Dead Sea at -430 m, and beside it a dry basin around -80 m that reaches the edge of the data.
TEST(RulePlaces, LakesBelowTheSeaStayLakesAndDryBasinsDry) {
  const Dem dem = test::ground(200, [](double east_m, double north_m) {
    return east_m < 0.0
               ? -430.0 + std::max(0.0, 0.2 * (std::hypot(east_m + 1500.0, north_m) - 600.0))
               : -80.0 + 0.015 * std::abs(east_m - 1500.0) + 0.004 * std::abs(north_m);
  });
  EXPECT_TRUE(find_sea(dem).empty());
  ClassRuleParameters parameters;
  parameters.seed = 7;
  parameters.climate = alpine_climate();
  for (Grid<float>& level : parameters.climate.moisture) level(0, 0) = 0.05F;
  const Grid<LandCoverClass> classes =
      apply_class_rules(read_class_rules("life_zones"), parameters, dem, silent_progress())
          .classes.cells;
  EXPECT_EQ(classes(50, 100), water);
  EXPECT_EQ(classes(40, 110), water);
  for (const auto [x, y] : test::cells({110, 0, 200, 200})) {
    ASSERT_NE(classes(x, y), water) << x << ' ' << y;
  }
}

struct WetPlace {
  MountainPlace place;
  ClassCounts
      counts;  // sky, water, valley floor, settlement, forest …, before dry country was known
};

TEST(RulePlaces, WetMountainsKeepEachCell) {
  const std::vector<WetPlace> places = {
      {{"Karwendel", 47.40, 11.50, 900, 2500},
       {0, 0, 577, 57, 2516, 858, 799, 307, 0, 0, 1271, 15, 0}},
      {{"Inn valley", 47.26, 11.39, 580, 2400},
       {0, 0, 579, 57, 3068, 606, 522, 413, 0, 0, 1155, 0, 0}},
      {{"Oetztal", 46.90, 10.90, 1500, 3400},
       {0, 0, 0, 0, 1301, 654, 818, 697, 477, 945, 1508, 0, 0}},
      {{"Rhone valley", 46.29, 7.88, 650, 3000},
       {0, 0, 578, 58, 2703, 106, 369, 1578, 106, 30, 865, 7, 0}},
      {{"Aletsch", 46.50, 8.05, 1400, 3800},
       {0, 0, 489, 51, 1463, 314, 377, 760, 1426, 637, 883, 0, 0}},
      {{"Briancon", 44.90, 6.65, 1300, 3000},
       {0, 0, 566, 57, 2400, 593, 1002, 589, 0, 0, 1157, 36, 0}},
      {{"Dolomites", 46.55, 11.90, 1300, 2900},
       {0, 0, 519, 53, 1930, 845, 1346, 518, 0, 0, 1189, 0, 0}},
      {{"Engadin", 46.53, 9.88, 1700, 3300},
       {0, 0, 0, 0, 1885, 1155, 846, 479, 354, 1017, 664, 0, 0}},
      {{"Fuji", 35.36, 138.73, 900, 3500}, {0, 0, 575, 58, 3360, 116, 85, 1386, 21, 0, 799, 0, 0}},
      {{"Khumbu", 27.80, 86.71, 3000, 5800},
       {0, 0, 563, 56, 1654, 114, 365, 2239, 462, 179, 768, 0, 0}},
      {{"Pokhara", 28.25, 83.97, 850, 2700}, {0, 0, 578, 57, 4580, 0, 0, 0, 0, 0, 1185, 0, 0}},
      {{"Manaslu, south", 28.35, 84.50, 1500, 4500},
       {0, 0, 569, 57, 3194, 93, 14, 1726, 0, 0, 747, 0, 0}},
      {{"Langtang", 28.20, 85.55, 3300, 5600},
       {0, 0, 490, 50, 1493, 595, 937, 1566, 263, 107, 899, 0, 0}},
      {{"Aoraki", -43.60, 170.15, 720, 2900},
       {0, 0, 506, 52, 1675, 237, 277, 596, 1224, 907, 926, 0, 0}},
      {{"Queenstown", -45.03, 168.70, 350, 2000},
       {0, 0, 555, 54, 2160, 608, 1201, 606, 14, 12, 1190, 0, 0}},
      {{"Alexandra", -45.25, 169.40, 150, 1300},
       {0, 0, 598, 58, 2839, 1038, 21, 0, 0, 0, 1835, 11, 0}},
  };
  for (const auto& [place, counts] : places)
    EXPECT_EQ(count_classes(cover_at(ground_at(place))), counts) << place.name;
}

}  // namespace
}  // namespace belvedere
