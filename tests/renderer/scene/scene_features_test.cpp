#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/scene/scene_file.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

LoadedScene parse(const std::string& text) { return parse_scene(text, "mine.toml", ".", {}); }

TEST(SceneFeatures, BlocksAreRead) {
  const LoadedScene loaded = parse(R"(version = 1
features_style = "ski"
[[features]]
source = "roads.gpkg"
layer = "lines"
where = "tunnel IS NULL"
kind_of = "highway"
kind = "road"
width_mm = 0.8
width_of = "width"
level_of = "level"
population_of = "people"
snap_m = 80
keep_inferred = true
optional = true
[[features]]
source = "lifts.geojson"
kind = "lift"
)");
  ASSERT_EQ(loaded.scene.features.size(), 2U);
  EXPECT_EQ(loaded.scene.features_style, "ski");
  const SceneFeatures& roads = loaded.scene.features[0];
  EXPECT_EQ(roads.source, "roads.gpkg");
  EXPECT_EQ(roads.layer, "lines");
  EXPECT_EQ(roads.where, "tunnel IS NULL");
  EXPECT_EQ(roads.kind_of, "highway");
  EXPECT_EQ(roads.kind, "road");
  EXPECT_EQ(roads.width_mm, 0.8);
  EXPECT_EQ(roads.width_of, "width");
  EXPECT_EQ(roads.level_of, "level");
  EXPECT_EQ(roads.population_of, "people");
  EXPECT_EQ(roads.snap_m, 80.0);
  EXPECT_TRUE(roads.keep_inferred);
  EXPECT_EQ(loaded.scene.features[1].snap_m, 150.0);
  EXPECT_TRUE(roads.optional);
  EXPECT_EQ(loaded.scene.features[1].kind, "lift");
}

TEST(SceneFeatures, AKindIsNeeded) {
  const auto message = [](const std::string& text) {
    return test::usage_error([&] { parse("version = 1\n" + text); });
  };
  EXPECT_THAT(message("[[features]]\nsource = \"roads.gpkg\"\n"),
              AllOf(HasSubstr("no kind"), HasSubstr("kind_of")));
  EXPECT_THAT(message("[[features]]\nkind = \"road\"\n"),
              HasSubstr("features.0.source is missing"));
  EXPECT_THAT(message("features_style = \"spring\"\n"), HasSubstr("\"classic\""));
}

// Their files belong to the scene like any other: found, checked, hashed.
TEST(SceneFeatures, FilesAreInputs) {
  const LoadedScene loaded = parse(
      "version = 1\n[[features]]\nsource = \"no_such.gpkg\"\nkind = \"road\"\norigin = \"a "
      "survey\"\nget_from = \"there\"\n");
  EXPECT_THAT(test::input_error([&] { require_scene_files(loaded); }),
              AllOf(HasSubstr("features.0.source"), HasSubstr("a survey"), HasSubstr("there")));
}

}  // namespace
}  // namespace belvedere
