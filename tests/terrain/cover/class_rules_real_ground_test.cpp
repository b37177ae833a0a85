#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>

#include "terrain/climate/climate.h"
#include "terrain/climate/default_climate.h"
#include "terrain/climate/map_climate.h"
#include "terrain/climate/map_position.h"
#include "terrain/cover/class_rules.h"
#include "tests/grids.h"
#include "tests/paths.h"

// Rules and the default climate on real elevation, compared with glacier inventories.
namespace belvedere {
namespace {

struct Region {
  const char* file;
  double cell_m;           // 0: the data's
  double inventory_share;  // of the ground, that glaciers cover
  const char* source;
};

void PrintTo(const Region& region, std::ostream* out) { *out << region.file; }

class IceOnRealGround : public testing::TestWithParam<Region> {};

TEST_P(IceOnRealGround, CoversWhatInventoriesCountWithinAFactorOfTwo) {
  const Region region = GetParam();
  const std::string file = test::data_folder() + "/" + region.file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  RasterSource source;
  source.path = file;
  const Dem dem = read_dem({.sources = {source}, .crs = {}, .cell_m = region.cell_m, .extent = {}},
                           silent_progress());
  const Climate climate = make_climate(
      dem, {}, [](glm::dvec2 lonlat) { return default_climate(lonlat.x, lonlat.y); },
      silent_progress());
  ClassRuleParameters parameters;
  parameters.climate = make_map_climate(dem, climate, {});
  parameters.climate.sun = sun_share(dem, climate.position, {});
  const LandCover cover =
      apply_class_rules(read_class_rules("life_zones"), parameters, dem, silent_progress());
  double ground = 0.0;
  double white = 0.0;
  double high = 0.0;
  double high_white = 0.0;
  double lowest_m = 9000.0;
  for (const auto [x, y] : test::cells(dem)) {
    if (dem.filled(x, y) != 0) continue;
    const LandCoverClass here = cover.classes.cells(x, y);
    const bool is_white = here == LandCoverClass::glacier || here == LandCoverClass::snow;
    ground += 1.0;
    white += is_white ? 1.0 : 0.0;
    const auto altitude_m = static_cast<double>(dem.altitude_m(x, y));
    if (is_white) lowest_m = std::min(lowest_m, altitude_m);
    if (altitude_m > 3600.0) {
      high += 1.0;
      high_white += is_white ? 1.0 : 0.0;
    }
  }
  const double share = white / ground;
  RecordProperty("share", std::to_string(share));
  EXPECT_GT(share, region.inventory_share / 2.0) << region.source;
  EXPECT_LT(share, region.inventory_share * 2.0) << region.source;
  EXPECT_GT(lowest_m, 850.0) << "no tongue of these regions comes lower";
  EXPECT_GE(high_white, 0.8 * high) << "far above the line all but walls are white";
}

INSTANTIATE_TEST_SUITE_P(
    Regions, IceOnRealGround,
    testing::Values(
        Region{"oetztal/srtm_oetztal.tif", 0.0, 0.112,
               "some 170 km² of 1520: Austria's inventory of 1969, and South Tyrol's of 1983"},
        Region{"aletsch/aletsch.tif", 0.0, 0.070,
               "some 310 km² of 4440: Swiss inventory of 2010, its glaciers above 1 km² added up"},
        Region{"rainier/mt_rainier_90m.tif", 180.0, 0.0130,
               "some 110 km² of 8490: Rainier 1971 (Driedger & Kennard 1986), Adams, Goat Rocks"},
        Region{"innsbruck/innsbruck_utm32_30m.tif", 120.0, 0.0065,
               "some 50 km² of 7980: northern Stubai and Zillertal 2006"}),
    [](const testing::TestParamInfo<Region>& tested) {
      const std::string name = tested.param.file;
      return name.substr(0, name.find('/'));
    });

}  // namespace
}  // namespace belvedere
