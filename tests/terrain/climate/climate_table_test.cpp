#include "terrain/climate/climate_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/files.h"

namespace belvedere {
namespace {

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
  EXPECT_THAT(message("version = 1\nhuts = [[\"A\", 9001]]\n"), HasSubstr("0 to 9000"));
}

}  // namespace
}  // namespace belvedere
