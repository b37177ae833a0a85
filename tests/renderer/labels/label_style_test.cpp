#include "renderer/labels/label_style.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(LabelStyle, TheClassicOneKnowsTheWordsOfMaps) {
  const LabelStyle style = load_label_style("classic");
  EXPECT_EQ(style.find("summit"), 0) << "points that say nothing are summits";
  EXPECT_EQ(style.find("Peak"), 0);
  EXPECT_EQ(style.kinds[static_cast<std::size_t>(style.find("village"))].position,
            LabelPlace::beside);
  EXPECT_EQ(style.kinds[static_cast<std::size_t>(style.find("reservoir"))].position,
            LabelPlace::over);
  EXPECT_EQ(style.find("spaceport"), -1);
}

TEST(LabelStyle, ReadsEveryKey) {
  const LabelStyle style = parse_label_style(R"(version = 1
min_px = 9
row_mm = 7
[kinds.hut]
also = ["shelter"]
place = "beside"
family = "Serif"
size_mm = 5
weight = 700
capitals = true
rank_step = 0.05
light = "#eeeeee"
barrier = true
straight = true
italic = true
spacing = 0.5
colour = "#102030"
halo = "#ffffff"
halo_mm = 1
mark = "square"
mark_mm = 2
altitude = true
climb_m = 30
)",
                                             "mine.toml");
  ASSERT_EQ(style.kinds.size(), 1U);
  const LabelKindStyle& hut = style.kinds[0];
  EXPECT_EQ(style.min_px, 9.0);
  EXPECT_EQ(style.row_mm, 7.0);
  EXPECT_EQ(hut.size_mm, 5.0);
  EXPECT_TRUE(hut.italic && hut.altitude && hut.capitals && hut.barrier && hut.straight);
  EXPECT_EQ(hut.weight, 700);
  EXPECT_EQ(hut.rank_step, .05);
  EXPECT_EQ(hut.light, "#eeeeee");
  EXPECT_EQ(hut.spacing, .5);
  EXPECT_EQ(hut.colour, "#102030");
  EXPECT_EQ(hut.mark, LabelMarkShape::square);
  EXPECT_EQ(hut.mark_mm, 2.0);
  EXPECT_EQ(hut.halo_mm, 1.0);
  EXPECT_EQ(hut.climb_m, 30.0);
  EXPECT_EQ(style.find("SHELTER"), 0);
}

TEST(LabelStyle, WhatIsWrongIsSaidAtItsPlace) {
  const auto message = [](const std::string& text) {
    return test::usage_error([&] { parse_label_style("version = 1\n" + text, "mine.toml"); });
  };
  EXPECT_THAT(message("[kinds.hut]\nsize_mm = 0\n"),
              AllOf(HasSubstr("mine.toml:3"), HasSubstr("0.5 … 100")));
  EXPECT_THAT(message("[kinds.hut]\ncolour = \"red\"\n"), HasSubstr("\"#rrggbb\""));
  EXPECT_THAT(message("[kinds.hut]\nplace = \"under\"\n"),
              HasSubstr("\"above\", \"beside\", \"over\", \"on\""));
  EXPECT_THAT(message("[kinds.hut]\nmak = \"dot\"\n"), HasSubstr("mak"));
  EXPECT_THAT(message(""), HasSubstr("no kinds"));
  EXPECT_THAT(test::usage_error([] { parse_label_style("[kinds.a]\n", "mine.toml"); }),
              HasSubstr("version = 1"));
  EXPECT_THAT(test::usage_error([] { load_label_style("baroque"); }), HasSubstr("classic, or"));
  EXPECT_THAT(test::input_error([] { load_label_style("/no/such.toml"); }),
              HasSubstr("/no/such.toml"));
}

}  // namespace
}  // namespace belvedere
