#include "tools/cli/new/new_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere::tools {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(ViewOptions, DirectionsByNameLettersAndDegrees) {
  EXPECT_EQ(read_direction("N"), 0.0);
  EXPECT_EQ(read_direction("southwest"), 225.0);
  EXPECT_EQ(read_direction("NNW"), 337.5);
  EXPECT_EQ(read_direction("225.5"), 225.5);
  EXPECT_EQ(read_direction("-90"), 270.0);
  for (const char* wrong : {"up", "", "north-south", "400", "1e999", "12 km"})
    EXPECT_THAT(test::usage_error([&] { read_direction(wrong); }), HasSubstr("--towards")) << wrong;
}

TEST(ViewOptions, PlacesAreLongitudeFirst) {
  EXPECT_EQ(read_lonlat("--from", "11.4,47.27"), glm::dvec2(11.4, 47.27));
  EXPECT_EQ(read_lonlat("--from", " -112.9 , 37.2 "), glm::dvec2(-112.9, 37.2));
  EXPECT_THAT(test::usage_error([] { read_lonlat("--from", "47.27"); }),
              AllOf(HasSubstr("--from"), HasSubstr("longitude")));
  EXPECT_THAT(test::usage_error([] { read_lonlat("--from", "11,99"); }), HasSubstr("\"11,99\""));
}

TEST(ViewOptions, PlacesWithNames) {
  const NamedPlace position = read_named_place("Hall in Tirol|11.51,47.28");
  EXPECT_EQ(position.name, "Hall in Tirol");
  EXPECT_EQ(position.lonlat, glm::dvec2(11.51, 47.28));
  EXPECT_EQ(read_named_place("11.51,47.28").name, "");
  EXPECT_THAT(test::usage_error([] { read_named_place("Innsbruck"); }),
              AllOf(HasSubstr("--include"), HasSubstr("Innsbruck|")));
}

TEST(ViewOptions, Formats) {
  EXPECT_EQ(read_format("2:1").picture.aspect, 2.0);
  EXPECT_EQ(read_format("1:1").picture.aspect, 1.0);
  EXPECT_NEAR(read_format("A2").picture.aspect, 594.0 / 420.0, 1e-12);
  EXPECT_EQ(read_format("a2").sheet_width_mm, 594.0);
  EXPECT_NEAR(read_format("A2 upright").picture.aspect, 420.0 / 594.0, 1e-12);
  EXPECT_EQ(read_format("A2 upright").sheet_width_mm, 420.0);
  EXPECT_EQ(read_format("3000x1000").picture.aspect, 3.0);
  EXPECT_EQ(read_format("3000x1000").width_px, 3000);
  EXPECT_TRUE(read_format("cylinder").picture.full_turn);
  EXPECT_EQ(read_format("cylinder 8:1").picture.aspect, 8.0);
  EXPECT_FALSE(read_format("5:1").picture.full_turn);
  for (const char* wrong :
       {"", "A9", "A", "wide", "2:0", "0:1", "100:1", "cylinder 2:1", "A2 lying down", "10x10"})
    EXPECT_THAT(test::usage_error([&] { read_format(wrong); }), HasSubstr("--format")) << wrong;
}

}  // namespace
}  // namespace belvedere::tools
