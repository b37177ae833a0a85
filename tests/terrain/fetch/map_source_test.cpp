#include "terrain/fetch/map_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text/embedded.h"
#include "terrain/fetch/tile_mosaic.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// The tile whose south-west corner lies there.
MapTile tile_of(const MapSource& source, int west, int south) {
  return {static_cast<int>((west - source.origin_deg.x) / source.tile_deg.x),
          static_cast<int>((source.origin_deg.y - south) / source.tile_deg.y) - 1};
}

std::string good_text() { return std::string(embedded_file("sources/copernicus_glo30.toml")); }

// The text with one replacement.
std::string with(const std::string& from, const std::string& to) {
  std::string text = good_text();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// Addresses as used by the services, written out.
TEST(MapSource, BuiltInOnesNameTilesAsTheirServicesDo) {
  EXPECT_THAT(built_in_map_sources(),
              ElementsAre("copernicus_glo30", "copernicus_glo90", "esa_worldcover"));
  const MapSource fine = read_map_source("copernicus_glo30");
  EXPECT_EQ(tile_address(fine, tile_of(fine, 11, 46), ""),
            "https://copernicus-dem-30m.s3.amazonaws.com/Copernicus_DSM_COG_10_N46_00_E011_00_DEM/"
            "Copernicus_DSM_COG_10_N46_00_E011_00_DEM.tif");
  EXPECT_EQ(tile_address(fine, tile_of(fine, -72, -13), "http://localhost:8000/maps/"),
            "http://localhost:8000/maps/Copernicus_DSM_COG_10_S13_00_W072_00_DEM/"
            "Copernicus_DSM_COG_10_S13_00_W072_00_DEM.tif");
  EXPECT_EQ(tile_name(fine, tile_of(fine, 0, 0)), "N00E000");
  EXPECT_EQ(tile_name(fine, tile_of(fine, -1, -1)), "S01W001");
  const MapSource coarse = read_map_source("copernicus_glo90");
  EXPECT_EQ(tile_address(coarse, tile_of(coarse, 44, 40), ""),
            "https://copernicus-dem-90m.s3.amazonaws.com/Copernicus_DSM_COG_30_N40_00_E044_00_DEM/"
            "Copernicus_DSM_COG_30_N40_00_E044_00_DEM.tif");
  const MapSource cover = read_map_source("esa_worldcover");
  EXPECT_EQ(tile_address(cover, tile_of(cover, 9, 45), ""),
            "https://esa-worldcover.s3.eu-central-1.amazonaws.com/v200/2021/map/"
            "ESA_WorldCover_10m_2021_v200_N45E009_Map.tif");
  EXPECT_EQ(cover.legend, "esa_worldcover");
}

TEST(MapSource, ColumnsGoRoundTheEarth) {
  const MapSource source = read_map_source("copernicus_glo30");
  EXPECT_EQ(tile_name(source, tile_of(source, 180, -17)), "S17W180");
  EXPECT_EQ(tile_name(source, tile_of(source, -181, -17)), "S17E179");
  EXPECT_EQ(tile_name(source, tile_of(source, 179, -17)), "S17E179");
}

// The product's handbook: 1″ up to 50°, then 1.5, 2, 3, 5 and 10″ from 50, 60, 70, 80 and 85° on,
// in both hemispheres.
TEST(MapSource, CellsOfGlo30AreWiderTowardsThePoles) {
  const MapSource source = read_map_source("copernicus_glo30");
  const auto columns_of = [&](int south) {
    return tile_columns(source, tile_of(source, 0, south).row);
  };
  EXPECT_EQ(columns_of(49), 3600);
  EXPECT_EQ(columns_of(50), 2400);
  EXPECT_EQ(columns_of(-50), 3600);
  EXPECT_EQ(columns_of(-51), 2400);
  EXPECT_EQ(columns_of(60), 1800);
  EXPECT_EQ(columns_of(79), 1200);
  EXPECT_EQ(columns_of(84), 720);
  EXPECT_EQ(columns_of(89), 360);
  EXPECT_EQ(columns_of(-90), 360);
}

// The attribution that the licences require.
TEST(MapSource, CreditsAreInTheWordsOfTheLicences) {
  for (const char* name : {"copernicus_glo30", "copernicus_glo90"}) {
    const MapSource source = read_map_source(name);
    EXPECT_THAT(source.credit, HasSubstr("© DLR e.V. 2010-2014 and © Airbus Defence and Space GmbH "
                                         "2014-2018 provided under COPERNICUS by the "
                                         "European Union and ESA; all rights reserved"));
    EXPECT_THAT(source.licence, HasSubstr("do not incur any liability"));
  }
  EXPECT_EQ(read_map_source("esa_worldcover").credit,
            "© ESA WorldCover project / Contains modified Copernicus Sentinel data (2021) "
            "processed by ESA WorldCover consortium");
}

TEST(MapSource, TilesOfAnAreaAreThoseThatHoldAPartOfIt) {
  const MapSource source = read_map_source("copernicus_glo30");
  const auto names = [&](const DegreeBox& box) {
    std::vector<std::string> out;
    for (const MapTile& tile : tiles_of(source, box)) out.push_back(tile_name(source, tile));
    return out;
  };
  EXPECT_THAT(names({11.2, 47.2, 11.8, 47.8}), ElementsAre("N47E011"));
  EXPECT_THAT(names({10.9, 46.9, 11.1, 47.1}),
              ElementsAre("N47E010", "N47E011", "N46E010", "N46E011"));
  EXPECT_THAT(names({179.9, -17.2, 180.1, -16.8}),
              ElementsAre("S17E179", "S17W180", "S18E179", "S18W180"));
  EXPECT_TRUE(tiles_of(read_map_source("esa_worldcover"), {0.0, -70.0, 1.0, -69.0}).empty());
}

TEST(MapSource, FieldsMayHaveMoreDigitsOrBeNumbers) {
  const MapSource wide = parse_map_source(with("Copernicus_DSM_COG_10_{lat}_00_{lon}_00_DEM/"
                                               "Copernicus_DSM_COG_10_{lat}_00_{lon}_00_DEM.tif",
                                               "{lat:3}{lon}.tif"),
                                          "x.toml");
  EXPECT_EQ(tile_address(wide, tile_of(wide, 11, 47), ""),
            "https://copernicus-dem-30m.s3.amazonaws.com/N047E011.tif");
  const MapSource numbers = parse_map_source(with("Copernicus_DSM_COG_10_{lat}_00_{lon}_00_DEM/"
                                                  "Copernicus_DSM_COG_10_{lat}_00_{lon}_00_DEM.tif",
                                                  "{row}/{column:4}.tif"),
                                             "x.toml");
  EXPECT_EQ(tile_address(numbers, {361, 42}, ""),
            "https://copernicus-dem-30m.s3.amazonaws.com/42/0001.tif");
}

TEST(MapSource, MistakesNamePlaceAndWhatIsAllowed) {
  struct Case {
    std::string from, to, message;
  };
  for (const Case& c :
       {Case{"kind = \"elevation\"", "kind = \"heights\"", "elevation"},
        Case{"url = \"https://", "url = \"ftp://", "not a valid URL"},
        Case{"{lat}", "{latitude}", "{latitude}"}, Case{"cell_m = 30", "cell_m = 0", "0.1"},
        Case{"missing = \"sea\"", "missing = \"zero\"", "nothing"},
        Case{"sea_value = 0\n", "", "\"sea_value\" is missing"},
        Case{"rows = 3600", "rows = 0", "1 … 100000"},
        Case{"[[0, 3600], ", "[[10, 3600], ", "ascending order from 0"},
        Case{"\"on the lines\"", "\"centred\"", "between the lines"},
        Case{"EPSG:4326", "EPSG:32632", "degrees"}, Case{"EPSG:4326", "EPSG:99", "grid.crs"},
        Case{"tile_deg = [1, 1]", "tile_deg = [0.7, 1]", "divide"},
        Case{"credit =", "credits =", "credit"},
        Case{"licence = ", "legend = \"x\"\nlicence = ", "legend for an elevation source"},
        Case{"https://copernicus-dem-30m.s3.amazonaws.com", "https://me:word@host", "password"}}) {
    const std::string message =
        test::usage_error([&] { parse_map_source(with(c.from, c.to), "mine.toml"); });
    EXPECT_THAT(message, HasSubstr(c.message)) << c.from << " → " << c.to;
  }
  EXPECT_THAT(test::usage_error([] { read_map_source("copernicus_glo3"); }),
              HasSubstr("copernicus_glo30"));
  EXPECT_THAT(test::input_error([] { read_map_source("none.toml"); }), HasSubstr("none.toml"));
}

}  // namespace
}  // namespace belvedere
