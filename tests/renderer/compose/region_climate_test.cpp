#include "renderer/compose/region_climate.h"

#include <gtest/gtest.h>

#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

CoarseGround region_at(const char* crs) {
  Raster<float> raster = test::synthetic_raster(40.0, test::chain);
  raster.crs = normalize_crs(crs);
  return make_coarse_ground(raster, 200.0);
}

TEST(RegionClimate, TheAlpsAreWetTheNamibIsDry) {
  const RegionClimate alps = region_climate(region_at("EPSG:32632"));
  ASSERT_TRUE(alps.known);
  EXPECT_GT(alps.moisture, 0.8);
  EXPECT_FALSE(is_canyon_country(alps));
  EXPECT_EQ(dry_palette(alps, 0.0), "");
  // The same northing below the Equator's false one of 10 000 km is 43° S; the desert lies in the
  // other hemisphere.
  Raster<float> raster = test::synthetic_raster(40.0, test::chain);
  raster.crs = normalize_crs("EPSG:32635");
  raster.transform.origin_y = 2700000.0;  // 24° N in Egypt
  const RegionClimate desert = region_climate(make_coarse_ground(raster, 200.0));
  EXPECT_LT(desert.moisture, 0.4);
  EXPECT_GT(desert.temperature_c, alps.temperature_c + 8.0);
  EXPECT_TRUE(is_canyon_country(desert));
  EXPECT_EQ(dry_palette(desert, 0.0), "desert");
}

TEST(RegionClimate, ColdDesertsSteppesAndCanyonsHaveColoursOfTheirOwn) {
  const auto colours = [](double moisture, double temperature_c, double plateau) {
    return dry_palette({.known = true,
                        .moisture = moisture,
                        .low_moisture = moisture,
                        .temperature_c = temperature_c},
                       plateau);
  };
  EXPECT_EQ(colours(0.15, -2.0, 0.0), "high_desert");  // Pamir
  EXPECT_EQ(colours(0.4, 4.0, 0.0), "steppe");         // Lhasa
  EXPECT_EQ(colours(0.4, 8.0, 0.8), "desert");         // Zion
  EXPECT_EQ(colours(0.15, 18.0, 0.0), "desert");       // Sinai
  EXPECT_EQ(colours(0.9, 4.0, 0.8), "");
  EXPECT_EQ(dry_palette({}, 1.0), "");
}

TEST(RegionClimate, NowhereIsNotKnown) {
  Raster<float> raster = test::synthetic_raster(40.0, test::chain);
  raster.crs.clear();
  EXPECT_FALSE(region_climate(make_coarse_ground(raster, 200.0)).known);
  EXPECT_FALSE(is_canyon_country({}));
}

}  // namespace
}  // namespace belvedere
