#include "renderer/scene/edit/scene_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "renderer/scene/scene_file.h"
#include "tests/renderer/scene/written_scene.h"

namespace belvedere {
namespace {

using test::scene_of;
using testing::Contains;
using testing::ElementsAre;
using testing::Key;
using testing::Not;
using testing::Pair;

constexpr auto text = R"(
[land_cover]
settings = { snowline_m = 2500, "odd name" = -1.5 }
[synthesis]
fallback = { shrub = "forest" }
[camera]
position = [1, 2]
look_at = [3, 4.5]
[sun]
azimuth_deg = 200
[[deform.handles]]
position = [5, 6]
[[deform.handles]]
position_lonlat = [7, 8]
move_m = [0, 500]
)";

TEST(SceneValues, AreThoseInEffect) {
  const auto list = scene_values(scene_of(text));
  const std::map<std::string, std::string> values(list.begin(), list.end());
  EXPECT_EQ(values.size(), list.size());
  EXPECT_THAT(values, Contains(Pair("version", "1")));
  EXPECT_THAT(values, Contains(Pair("camera.look_at", "[3, 4.5]")));
  EXPECT_THAT(values, Contains(Pair("camera.projection", "\"perspective\"")));
  EXPECT_THAT(values, Contains(Pair("deform.handles.0.position", "[5, 6]")));
  EXPECT_THAT(values, Contains(Pair("deform.handles.1.move_m", "[0, 500]")));
  EXPECT_THAT(values,
              Contains(Pair("land_cover.settings", R"({ "snowline_m": 2500, "odd name": -1.5 })")));
  EXPECT_THAT(values, Contains(Pair("synthesis.fallback", R"({ "shrub": "forest" })")));
  // Unset, or excluded by what is set.
  for (const char* key :
       {"camera.azimuth_deg", "camera.look_at_altitude_m", "deform.handles.2.move_m",
        "deform.handles.1.position", "margin.legend", "title"})
    EXPECT_THAT(values, Not(Contains(Key(key))));
}

TEST(SceneValues, SetAgainTheyGiveTheSameScene) {
  const Scene scene = scene_of(text);
  std::vector<std::string> settings;
  for (const auto& [key, value] : scene_values(scene, ValueForm::toml))
    settings.push_back(key + "=" + value);
  EXPECT_EQ(write_scene(scene_of("", settings)), write_scene(scene));
}

TEST(SceneValues, OfOneSection) {
  EXPECT_THAT(scene_values(scene_of(text), ValueForm::json, "sun"),
              ElementsAre(Pair("sun.azimuth_deg", "200"), Pair("sun.radius_deg", "1.72")));
  EXPECT_THAT(scene_values(scene_of(text), ValueForm::json, "deform.handles.1"),
              Contains(Pair("deform.handles.1.position_lonlat", "[7, 8]")));
}

}  // namespace
}  // namespace belvedere
