#include "terrain/climate/rule_climate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/files.h"

namespace belvedere {
namespace {

// Posts 300 m apart on cells of 100 m: the second post stands on the fourth cell.
RuleClimate climate() {
  RuleClimate c = alpine_climate();
  c.line_posts = c.table_posts = {-100.0, 1100.0, 300.0, 300.0};
  for (Grid<float>* line : {&c.treeline_m, &c.ice_line_m, &c.snow_line_m, &c.season_snow_m})
    *line = Grid<float>(2, 2, (*line)(0, 0));
  for (auto* table : {&c.temperature_c, &c.rain_mm})
    for (Grid<float>& level : *table) level = Grid<float>(2, 2, level(0, 0));
  c.treeline_m(0, 0) = 1000.F;
  c.treeline_m(1, 0) = 1300.F;
  c.treeline_m(0, 1) = 1600.F;
  c.treeline_m(1, 1) = 1900.F;
  c.lowest_m = 0.0;
  c.step_m = 1000.0;
  c.moisture.clear();
  for (const float at_level : {0.2F, 0.6F}) c.moisture.emplace_back(2, 2, at_level);
  return c;
}
constexpr GeoTransform cells{0.0, 1000.0, 100.0, 100.0};

TEST(RuleClimate, LinesAreStraightBetweenPostsAndConstantBeyond) {
  const std::array<float, 6> altitude{};
  std::array<float, 6> row{};
  fill_climate_row(climate(), ClimateVariable::treeline, cells, 0, 6, altitude.data(), row.data());
  EXPECT_NEAR(row[0], 1000.F, 1e-3F);
  EXPECT_NEAR(row[1], 1100.F, 1e-3F);
  EXPECT_NEAR(row[3], 1300.F, 1e-3F);
  EXPECT_NEAR(row[5], 1300.F, 1e-3F);
  fill_climate_row(climate(), ClimateVariable::treeline, cells, 1, 6, altitude.data(), row.data());
  EXPECT_NEAR(row[0], 1200.F, 1e-3F);
  fill_climate_row(climate(), ClimateVariable::treeline, cells, 9, 6, altitude.data(), row.data());
  EXPECT_NEAR(row[3], 1900.F, 1e-3F);
}

TEST(RuleClimate, GridsShareTheirPosts) {
  EXPECT_NO_THROW(plan_climate_columns(climate(), cells, 6));
  RuleClimate line = climate();
  line.snow_line_m = Grid<float>(1, 2, 2600.F);
  EXPECT_THROW(plan_climate_columns(line, cells, 6), Error);
  RuleClimate table = climate();
  table.rain_mm[1] = Grid<float>(2, 1, 900.F);
  EXPECT_THROW(plan_climate_columns(table, cells, 6), Error);
  RuleClimate none = climate();
  none.ice_line_m = {};
  EXPECT_THROW(plan_climate_columns(none, cells, 6), Error);
}

TEST(RuleClimate, TablesAreStraightOverAltitude) {
  const std::array<float, 4> altitude = {-500.F, 250.F, 1000.F, 4000.F};
  std::array<float, 4> row{};
  fill_climate_row(climate(), ClimateVariable::moisture, cells, 2, 4, altitude.data(), row.data());
  EXPECT_NEAR(row[0], 0.2F, 1e-6F);
  EXPECT_NEAR(row[1], 0.3F, 1e-6F);
  EXPECT_NEAR(row[2], 0.6F, 1e-6F);
  EXPECT_NEAR(row[3], 0.6F, 1e-6F);
}

TEST(RuleClimate, WithoutAPlaceItIsTheNorthernAlps) {
  const std::array<float, 2> altitude = {500.F, 2500.F};
  std::array<float, 2> row{};
  fill_climate_row(alpine_climate(), ClimateVariable::treeline, cells, 0, 2, altitude.data(),
                   row.data());
  EXPECT_EQ(row[1], 1820.F);
  fill_climate_row(alpine_climate(), ClimateVariable::temperature, cells, 0, 2, altitude.data(),
                   row.data());
  EXPECT_NEAR(row[0] - row[1], 11.F, 1e-4F);  // 5.5 K a km
  fill_climate_row(alpine_climate(), ClimateVariable::season_snow, cells, 0, 2, altitude.data(),
                   row.data());
  EXPECT_EQ(row[0], no_season_snow_m);
}

using testing::ElementsAre;
using testing::HasSubstr;

constexpr ClimateTable huts{"huts", "hut", 2, "name, altitude"};

std::vector<std::string> names_of(const std::string& text) {
  std::vector<std::string> names;
  for_each_row(text, "huts.toml", huts, [&](const ClimateRow& row) {
    names.push_back(row.text(0) + std::to_string(static_cast<int>(row.number(1, 0.0, 9000.0))));
  });
  return names;
}
std::string message(const std::string& text) {
  return test::error_of([&] { names_of(text); }).what();
}

TEST(ClimateTable, RowsComeInOrder) {
  EXPECT_THAT(names_of("version = 1\nhuts = [[\"A\", 1200], [\"B\", 3]]\n"),
              ElementsAre("A1200", "B3"));
}

TEST(ClimateTable, SaysWhichRowIsWrong) {
  EXPECT_THAT(message("version = 2\nhuts = []\n"), HasSubstr("not a table of huts"));
  EXPECT_THAT(message("version = 1\nhuts = [\n[\"A\"],\n]\n"),
              testing::AllOf(HasSubstr("huts.toml:3"), HasSubstr("name, altitude")));
  EXPECT_THAT(message("version = 1\nhuts = [[\"A\", 9001]]\n"), HasSubstr("0 … 9000"));
}

}  // namespace

}  // namespace belvedere
