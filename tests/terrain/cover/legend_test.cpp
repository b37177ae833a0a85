#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrain/cover/land_cover.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using enum LandCoverClass;
using testing::HasSubstr;

class Legends : public RasterFiles {};

LandCoverClass class_of(const Legend& legend, int code) {
  const auto found = legend.entries.find(code);
  return found == legend.entries.end() ? sky : found->second.painted_as;
}

TEST_F(Legends, BuiltInOnesAreWhole) {
  const Legend esa = read_legend("esa_worldcover");
  for (const int code : {10, 20, 30, 40, 50, 60, 70, 80, 90, 95, 100})
    EXPECT_TRUE(esa.entries.contains(code)) << code;
  EXPECT_EQ(esa.entries.size(), 11U);

  const Legend nlcd = read_legend("nlcd");
  for (const int code :
       {11, 12, 21, 22, 23, 24, 31, 41, 42, 43, 51, 52, 71, 72, 73, 74, 81, 82, 90, 95})
    EXPECT_TRUE(nlcd.entries.contains(code)) << code;
  EXPECT_EQ(nlcd.entries.size(), 20U);
  EXPECT_EQ(nlcd.entries.at(42).label, "Evergreen forest");

  const Legend fuel = read_legend("fbfm40");
  EXPECT_EQ(fuel.entries.size(), 5U + 9U + 4U + 9U + 5U + 9U + 4U);
  for (int code = 101; code <= 109; ++code) EXPECT_EQ(class_of(fuel, code), pasture);
  for (int code = 121; code <= 124; ++code) EXPECT_EQ(class_of(fuel, code), shrub);
  for (int code = 141; code <= 149; ++code) EXPECT_EQ(class_of(fuel, code), shrub);
  for (int code = 161; code <= 165; ++code) EXPECT_EQ(class_of(fuel, code), forest);
  for (int code = 181; code <= 189; ++code) EXPECT_EQ(class_of(fuel, code), forest);
  for (int code = 201; code <= 204; ++code) EXPECT_EQ(class_of(fuel, code), forest);
  EXPECT_EQ(class_of(fuel, 98), water);
  EXPECT_EQ(class_of(fuel, 99), rock);
}

TEST_F(Legends, CorineTakesItsCodesAndItsRasterNumbers) {
  const Legend legend = read_legend("corine");
  EXPECT_EQ(legend.entries.size(), 88U);
  int number = 0;
  for (const auto& [code, entry] : legend.entries) {
    if (code < 111) continue;
    ++number;  // in the order of the codes
    ASSERT_TRUE(legend.entries.contains(number));
    EXPECT_EQ(legend.entries.at(number).label, entry.label);
    EXPECT_EQ(class_of(legend, number), entry.painted_as);
  }
  EXPECT_EQ(number, 44);
  EXPECT_EQ(class_of(legend, 312), forest);
  EXPECT_EQ(class_of(legend, 34), glacier);
  EXPECT_EQ(class_of(legend, 523), water);
  EXPECT_EQ(class_of(legend, 331), sand);
}

TEST_F(Legends, UnknownNamesAreErrorsWithTheNearest) {
  EXPECT_THAT(test::usage_error([] { read_legend("nlcdd"); }), HasSubstr("\"nlcd\""));
  EXPECT_EQ(error_of([&] { read_legend(path("none.csv")); }).kind(), ErrorKind::input);
  EXPECT_EQ(error_of([&] { read_legend(path("none.toml")); }).kind(), ErrorKind::input);
}

TEST_F(Legends, CsvWithClasses) {
  write_text("a.csv",
             "\xef\xbb\xbf"
             "Value; Label ;Class\r\n1;\"Wald; \"\"dicht\"\"\";forest\r\n\r\n7;See;water\r\n");
  const Legend legend = read_legend(path("a.csv"));
  EXPECT_EQ(legend.entries.size(), 2U);
  EXPECT_EQ(legend.entries.at(1).label, "Wald; \"dicht\"");
  EXPECT_EQ(class_of(legend, 7), water);
  const auto refused = [&](const std::string& text) {
    write_text("b.csv", text);
    return test::usage_error([&] { read_legend(path("b.csv")); });
  };
  EXPECT_THAT(refused("code,class\n1,forest\n2,woods\n"), HasSubstr("b.csv:3"));
  EXPECT_THAT(refused("code,class\n1,forest\n1,water\n"), HasSubstr("duplicate code"));
  EXPECT_THAT(refused("code,class\nx,forest\n"), HasSubstr("b.csv:2"));
  EXPECT_THAT(refused("code,class\n1,\"forest\n"), HasSubstr("quote"));
  EXPECT_THAT(refused("code,class\n1,forest,2\n"), HasSubstr("3 fields"));
  EXPECT_THAT(refused("code,fuel\n1,C-1\n"), HasSubstr("TOML"));
  EXPECT_THAT(refused("class\nforest\n"), HasSubstr("codes"));
}

TEST_F(Legends, TomlWithCodes) {
  write_text("a.toml",
             "nodata = [0]\n[codes]\n3 = \"rock\"\n4 = { label = \"Wood\", class = \"forest\", "
             "also = [40, 41] }\n5 = { class = \"water\", "
             "also = 50 }\n");
  const Legend legend = read_legend(path("a.toml"));
  EXPECT_EQ(legend.name, "a");
  EXPECT_EQ(class_of(legend, 3), rock);
  EXPECT_EQ(class_of(legend, 41), forest);
  EXPECT_EQ(class_of(legend, 50), water);
  EXPECT_TRUE(legend.nodata.contains(0));
  const auto refused = [&](const std::string& text) {
    write_text("b.toml", text);
    return test::usage_error([&] { read_legend(path("b.toml")); });
  };
  EXPECT_THAT(refused("[codes]\n3 = \"rocks\"\n"), HasSubstr("b.toml:2:5"));
  EXPECT_THAT(refused("[codes]\n3 = \"sky\"\n"), HasSubstr("unknown class"));
  EXPECT_THAT(refused("[codes]\nx = \"rock\"\n"), HasSubstr("b.toml:2:1"));
  EXPECT_THAT(refused("[codes]\n3 = { label = \"Wood\" }\n"), HasSubstr("class"));
  EXPECT_THAT(refused("[codes]\n3 = { class = \"rock\", also = 3 }\n"),
              HasSubstr("duplicate code"));
  EXPECT_THAT(refused("[codez]\n3 = \"rock\"\n"), HasSubstr("codes"));
  EXPECT_THAT(refused("name = \"nothing\"\n"), HasSubstr("no codes"));
  EXPECT_THAT(refused("match = \"x\"\n[codes]\n3 = \"rock\"\n"), HasSubstr("csv"));
}

TEST_F(Legends, TomlThatMapsTheWordsOfATable) {
  write_text("table.csv",
             "grid_value, descriptive_name, fuel_type\n1,Spruce,C-1\n13,Aspen,D-1/D-2\n31,Matted "
             "Grass,O-1a\n101,Non-fuel,Non-fuel\n102,Water,Non-fuel\n200,Odd,X\n");
  write_text("a.toml",
             "name = \"Fuel\"\ncsv = \"table.csv\"\nmatch = [\"fuel_type\", \"descriptive_name\"]\n"
             "[map]\n\"water\" = \"water\"\n\"Non-*\" = \"rock\"\n\"[CD]-?\" = \"snow\"\n\"?-1*\" "
             "= \"forest\"\n\"*grass\" = "
             "\"pasture\"\n[codes]\n31 = \"shrub\"\n");
  const Legend legend = read_legend(path("a.toml"));
  EXPECT_EQ(class_of(legend, 1), forest);
  EXPECT_EQ(class_of(legend, 13), forest);
  EXPECT_EQ(class_of(legend, 31), shrub);  // its own codes go before the table
  EXPECT_EQ(class_of(legend, 101), rock);
  EXPECT_EQ(class_of(legend, 102), water);  // the first pattern that fits
  EXPECT_EQ(class_of(legend, 200), sky);    // none: not in the legend
  EXPECT_EQ(legend.entries.at(102).label, "Water");
}

TEST_F(Legends, TablesAreFoundInTheFoldersGivenAndNowhereElse) {
  std::filesystem::create_directories(folder_ / "scene");
  std::filesystem::create_directories(folder_ / "data");
  write_text("data/t.csv", "code,label\n1,Wood\n");
  write_text("t.csv", "code,label\n1,Wood\n");
  const auto legend_naming = [&](const std::string& file) {
    return write_text("scene/a.toml", "csv = \"" + file + "\"\n[map]\n\"*\" = \"forest\"\n");
  };
  const std::string legend = legend_naming("t.csv");
  EXPECT_EQ(error_of([&] { read_legend(legend); }).kind(), ErrorKind::input);
  EXPECT_EQ(class_of(read_legend(legend, {path("data")}), 1), forest);
  legend_naming("../t.csv");
  EXPECT_EQ(error_of([&] { read_legend(legend); }).kind(), ErrorKind::usage);
  legend_naming(path("t.csv"));
  EXPECT_EQ(error_of([&] { read_legend(legend); }).kind(), ErrorKind::usage);
  legend_naming("link.csv");
  std::filesystem::create_symlink(path("t.csv"), folder_ / "scene/link.csv");
  EXPECT_EQ(error_of([&] { read_legend(legend); }).kind(), ErrorKind::usage);
}

}  // namespace
}  // namespace belvedere
