#include "renderer/features/feature_style.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/text/embedded.h"
#include "terrain/io/crs.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const FeatureKind& kind_of(const FeatureStyle& style, const std::string& word) {
  const int k = style.find(word);
  EXPECT_GE(k, 0) << word;
  return style.kinds[static_cast<std::size_t>(std::max(0, k))];
}

std::string message(const std::string& text) {
  return test::usage_error([&] { parse_feature_style(text, "mine.toml"); });
}

TEST(FeatureStyle, BuiltInOnesKnowTheSameKindsAndTheWordsOfMaps) {
  const FeatureStyle classic = load_feature_style("classic");
  const FeatureStyle ski = load_feature_style("ski");
  EXPECT_EQ(classic.names(), ski.names()) << "a scene changes its style without other words";
  for (const FeatureStyle& style : {classic, ski}) {
    EXPECT_EQ(kind_of(style, "Motorway").draw, FeatureDraw::line);
    EXPECT_EQ(kind_of(style, "footway").name, "path");
    EXPECT_EQ(kind_of(style, "chair_lift").draw, FeatureDraw::cable);
    EXPECT_EQ(kind_of(style, "easy").draw, FeatureDraw::band);
    EXPECT_EQ(kind_of(style, "reservoir").ground, LandCoverClass::water);
    EXPECT_EQ(kind_of(style, "house").draw, FeatureDraw::building);
    EXPECT_GT(kind_of(style, "motorway").rank, kind_of(style, "road").rank);
    EXPECT_GT(kind_of(style, "motorway").width_mm, kind_of(style, "road").width_mm);
    EXPECT_EQ(style.find("spaceport"), -1);
  }
  EXPECT_EQ(embedded_names("features"), (std::vector<std::string>{"classic", "ski"}));
}

TEST(FeatureStyle, ReadsEveryKey) {
  const FeatureStyle style = parse_feature_style(R"(version = 1
[kinds.way]
also = ["lane"]
draw = "band"
rank = 12
width_mm = 2
min_px = 3
real_m = 4
shrink = 0.25
min_share = 0.6
casing_mm = 0.7
bed_mm = 0.8
soft_mm = 0.9
opacity = 0.5
dash_mm = [3, 4]
hand = 0.3
coarsest_m = 20
clear_mm = 1.5
height_mm = 2.5
height_m = 15
pylon_mm = 7
fill = "#ff0080"
casing = "#000000"
bed = "#ffffff"
winter = { fill = "#0000ff" }
ground = "forest"
level = true
)",
                                                 "mine.toml");
  ASSERT_EQ(style.kinds.size(), 1U);
  const FeatureKind& way = style.kinds[0];
  EXPECT_EQ(style.find("LANE"), 0);
  EXPECT_EQ(way.draw, FeatureDraw::band);
  EXPECT_EQ(way.rank, 12.0);
  EXPECT_EQ(way.width_mm, 2.0);
  EXPECT_EQ(way.min_px, 3.0);
  EXPECT_EQ(way.real_m, 4.0);
  EXPECT_EQ(way.shrink, .25);
  EXPECT_EQ(way.min_share, .6);
  EXPECT_EQ(way.casing_mm, .7);
  EXPECT_EQ(way.bed_mm, .8);
  EXPECT_EQ(way.soft_mm, .9);
  EXPECT_EQ(way.opacity, .5);
  EXPECT_EQ(way.dash_mm, glm::dvec2(3.0, 4.0));
  EXPECT_EQ(way.hand, .3);
  EXPECT_EQ(way.coarsest_m, 20.0);
  EXPECT_EQ(way.clear_mm, 1.5);
  EXPECT_EQ(way.height_mm, 2.5);
  EXPECT_EQ(way.height_m, 15.0);
  EXPECT_EQ(way.pylon_mm, 7.0);
  EXPECT_EQ(way.summer.fill, glm::vec3(1.F, 0.F, 128.F / 255.F));
  EXPECT_EQ(way.winter.fill, glm::vec3(0.F, 0.F, 1.F));
  EXPECT_EQ(way.winter.casing, glm::vec3(0.F)) << "unset winter values are those of summer";
  EXPECT_EQ(way.winter.bed, glm::vec3(1.F));
  EXPECT_EQ(way.ground, LandCoverClass::forest);
  EXPECT_TRUE(way.level);
}

TEST(FeatureStyle, WhatIsWrongIsSaidAtItsPlace) {
  EXPECT_THAT(message("version = 1\n"), HasSubstr("the style has no kinds"));
  EXPECT_THAT(message("[kinds.road]\n"), HasSubstr("the version is missing"));
  EXPECT_THAT(message("version = 1\n[kinds.road]\nwidth_mm = 90\n"),
              AllOf(HasSubstr("mine.toml:3"), HasSubstr("0 … 50")));
  EXPECT_THAT(message("version = 1\n[kinds.road]\nwidht_mm = 1\n"),
              AllOf(HasSubstr("mine.toml:3"), HasSubstr("widht_mm")));
  EXPECT_THAT(message("version = 1\n[kinds.road]\nfill = \"red\"\n"),
              AllOf(HasSubstr("mine.toml:3"), HasSubstr("#rrggbb")));
  EXPECT_THAT(message("version = 1\n[kinds.road]\ndash_mm = [1]\n"), HasSubstr("two numbers"));
  EXPECT_THAT(message("version = 1\n[kinds.road]\ndraw = \"air\"\n"),
              AllOf(HasSubstr("\"line\""), HasSubstr("\"cable\"")));
  EXPECT_THAT(message("version = 1\n[kinds.wood]\ndraw = \"area\"\n"), HasSubstr("has no class"));
  EXPECT_THAT(message("version = 1\n[kinds.wood]\nground = \"sky\"\n"),
              HasSubstr("a land-cover class"));
  EXPECT_THAT(message("version = 1\n[kinds.a]\nalso = [\"B\"]\n[kinds.b]\n"),
              HasSubstr("\"b\" names two kinds"));
  EXPECT_THAT(test::usage_error([] { load_feature_style("spring"); }),
              AllOf(HasSubstr("spring"), HasSubstr("classic, ski")));
}

class Sources : public testing::Test {
 protected:
  std::string write(const std::string& features) const {
    return folder_.write("roads.geojson",
                         "{\"type\": \"FeatureCollection\", \"features\": [" + features + "]}");
  }
  static std::string line(const std::string& properties) {
    return "{\"type\": \"Feature\", \"properties\": {" + properties +
           "}, \"geometry\": {\"type\": \"LineString\", \"coordinates\": [[11, 47], [11.1, 47]]}}";
  }
  FeatureSet read(const FeatureSource& source) const {
    return read_feature_set(load_feature_style("classic"), {source}, normalize_crs("EPSG:32632"));
  }
  const FeatureKind& kind_of(const FeatureSet& set, std::size_t i) const {
    return set.style.kinds[static_cast<std::size_t>(set.features[i].kind)];
  }
  test::Folder folder_;
};

TEST_F(Sources, KindsComeFromAColumn) {
  const std::string file =
      write(line("\"highway\": \"primary\", \"w\": \"7,5 m\"") + "," +
            line("\"highway\": \"Footway\", \"w\": \"wide\"") + "," +
            line("\"highway\": \"elevator\"") + "," + line("\"highway\": \"house\""));
  const FeatureSet set =
      read({.file = file, .kind_of = "highway", .width_of = "w", .key = "features.0"});
  ASSERT_EQ(set.features.size(), 2U);
  EXPECT_EQ(kind_of(set, 0).name, "main_road");
  EXPECT_FLOAT_EQ(set.features[0].real_m, 7.5F);
  EXPECT_EQ(kind_of(set, 1).name, "path");
  EXPECT_FLOAT_EQ(set.features[1].real_m, static_cast<float>(kind_of(set, 1).real_m))
      << "no length: the style's";
  const SourceReading& reading = set.readings[0];
  EXPECT_EQ(reading.read, 4U);
  EXPECT_EQ(reading.taken, 2U);
  EXPECT_EQ(reading.wrong_width, 1U);
  EXPECT_EQ(reading.unknown.at("elevator"), 1U);
  EXPECT_EQ(reading.wrong_shape, 1U) << "a house is no line";
  EXPECT_LT(reading.low.x, reading.high.x);
}

TEST_F(Sources, OrAreSaid) {
  const std::string file = write(line("\"highway\": \"elevator\""));
  const FeatureSet set =
      read({.file = file, .kind = "railway", .width_mm = 1.25, .key = "features.0"});
  ASSERT_EQ(set.features.size(), 1U);
  EXPECT_EQ(kind_of(set, 0).name, "railway");
  EXPECT_FLOAT_EQ(set.features[0].width_mm, 1.25F);
  // With a column, the features whose kind is unknown.
  const FeatureSet rest =
      read({.file = file, .kind = "track", .kind_of = "highway", .key = "features.0"});
  EXPECT_EQ(kind_of(rest, 0).name, "track");
  EXPECT_FLOAT_EQ(rest.features[0].width_mm, static_cast<float>(kind_of(rest, 0).width_mm));
}

TEST_F(Sources, AWordThatTheStyleDoesNotKnowIsSaidWithThoseItKnows) {
  const std::string file = write(line(""));
  EXPECT_THAT(test::usage_error([&] { read({.file = file, .kind = "raod", .key = "features.3"}); }),
              AllOf(HasSubstr("features.3.kind"), HasSubstr("did you mean \"road\""),
                    HasSubstr("motorway")));
}

}  // namespace
}  // namespace belvedere
