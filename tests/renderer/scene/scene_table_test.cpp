#include "renderer/scene/scene_table.h"
#include "renderer/paint/base_picture.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "base/error.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/sky.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/guidance.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

// Members shared with a stage have one type, so there is no second default to drift.
static_assert(std::is_same_v<decltype(SceneAir::look), decltype(BaseParameters::air)>);
static_assert(std::is_same_v<decltype(Scene::light), decltype(ToneParameters::light)>);
static_assert(std::is_same_v<decltype(Scene::water), decltype(BaseParameters::water)>);
static_assert(std::is_same_v<decltype(Scene::sampling), decltype(GuidanceParameters::sampling)>);

double number(const SceneField& field) {
  if (const auto* real = std::get_if<double*>(&field)) return **real;
  if (const auto* single = std::get_if<float*>(&field)) return static_cast<double>(**single);
  if (const auto* whole = std::get_if<int*>(&field)) return **whole;
  ADD_FAILURE() << "no number";
  return 0.0;
}

// The default of a key, by its full name.
double default_of(const std::string& name) {
  Scene scene;
  const std::size_t dot = name.rfind('.');
  const SceneSection* section = find_section(name.substr(0, dot));
  const SceneKey* key = section == nullptr ? nullptr : find_key(*section, name.substr(dot + 1));
  if (key == nullptr) {
    ADD_FAILURE() << name;
    return 0.0;
  }
  if (section->resize != nullptr) section->resize(scene, 1);
  return number(key->field(scene, 0));
}

// Where a stage's default is changed, that of the scene follows: each is written once.
TEST(SceneTable, DefaultsAreThoseOfTheStages) {
  const std::map<std::string, double> of_stages = {
      {"climate.temperature_factor", ClimateParameters{}.temperature_factor},
      {"air.haze", BaseParameters{}.air.haze},
      {"air.range_mist", BaseParameters{}.air.range_mist},
      {"air.warm_near", BaseParameters{}.air.warm_near},
      {"air.hue_drift", BaseParameters{}.air.hue_drift},
      {"air.clouds", SkyParameters{}.clouds},
      {"light.sun", ToneParameters{}.light.sun},
      {"light.sky", ToneParameters{}.light.sky},
      {"light.relief", ToneParameters{}.light.relief},
      {"light.shadow_depth", ToneParameters{}.light.shadow_depth},
      {"light.contrast", ToneParameters{}.light.contrast},
      {"sampling.pixel_samples", GuidanceParameters{}.sampling.pixel_samples},
      {"sampling.shadow_rays", GuidanceParameters{}.sampling.shadow_rays},
      {"sampling.sky_directions", GuidanceParameters{}.sampling.sky_directions},
      {"sampling.sky_reach_m", GuidanceParameters{}.sampling.sky_reach_m},
      {"synthesis.reuse", SynthesisParameters{}.reuse},
      {"synthesis.copy_cap", SynthesisParameters{}.copy_cap},
      {"synthesis.levels", SynthesisParameters{}.levels},
      {"camera.field_of_view_deg", CameraParameters{}.field_of_view_deg},
      {"camera.view_width_m", CameraParameters{}.view_width_m},
      {"output.width", SkyParameters{}.picture_size.x},
      {"output.height", CameraParameters{}.height},
      {"terrain.cell_m", DemParameters{}.cell_m},
      {"terrain.max_void_share", DemParameters{}.max_void_share},
      {"terrain.max_mcells", SceneTerrain{}.max_mcells},
      {"terrain.sources.band", RasterSource{}.band},
      {"land_cover.sources.band", RasterSource{}.band},
      {"terrain.synthetic.cell_m", SyntheticParameters{}.cell_m},
      {"land_cover.smallest_patch_m2", PatchParameters{}.smallest_m2},
      {"generalize.base", GeneralizeParameters{}.base},
      {"generalize.crest", GeneralizeParameters{}.crest},
      {"generalize.widen_valleys_m", WidenValleysParameters{}.width_m},
      {"deform.refraction", DeformParameters{}.refraction},
      {"deform.summits.radius_m", SummitExaggeration{}.radius_m},
      {"deform.summits.factor", SummitExaggeration{}.factor},
      {"deform.handles.scale", DeformHandle{}.scale},
  };
  for (const auto& [name, value] : of_stages) EXPECT_EQ(default_of(name), value) << name;
  EXPECT_DOUBLE_EQ(to_radians(default_of("sun.radius_deg")), GuidanceParameters{}.sun_radius_rad);
  EXPECT_EQ(Scene{}.camera.projection, CameraParameters{}.projection);
  EXPECT_EQ(Scene{}.tracing.instruction_set, TracerParameters{}.instruction_set);
}

// Keys that are derived from the region have no default, and can be set to "auto".
TEST(SceneTable, DerivedKeysAreAutoWhereNotWritten) {
  int derived = 0;
  for (const SceneSection& section : scene_sections())
    for (const SceneKey& key : section.keys) {
      if (key.derived.empty()) continue;
      ++derived;
      Scene scene;
      const SceneField field = key.field(scene, 0);
      const auto* flag = std::get_if<std::optional<bool>*>(&field);
      const auto* number = std::get_if<std::optional<double>*>(&field);
      ASSERT_TRUE(flag != nullptr || number != nullptr) << key.name;
      EXPECT_FALSE(flag != nullptr ? (*flag)->has_value() : (*number)->has_value()) << key.name;
      EXPECT_THAT(scene_reference(), HasSubstr(std::string(key.derived))) << key.name;
      const std::string name = join_key(section.name, key.name);
      const auto with = [&](const std::string& value) {
        return write_scene(parse_scene("version = 1\n", "s.toml", ".",
                                       {.data_folders = {}, .settings = {name + "=" + value}})
                               .scene);
      };
      EXPECT_EQ(with("auto"), with("\"auto\"")) << name;
      const char* other = flag != nullptr                               ? "true"
                          : key.unit == "m" || key.name == "rim_fade_m" ? "1000"
                          : key.name == "neighbourhood"                 ? "7"
                                                                        : "2";
      EXPECT_NE(with("auto"), with(other)) << name;
    }
  EXPECT_EQ(derived, 18);
  EXPECT_THAT(scene_reference(),
              HasSubstr("| `exaggeration` | a number or \"auto\"; 0.1 … 10 | `\"auto\"` |"));
}

// The reference contains the same.
TEST(SceneTable, DefaultsReachSchemaReferenceAndWrittenScene) {
  const double haze = AirParameters{}.haze;
  EXPECT_THAT(write_scene(Scene{}), HasSubstr(fmt::format("\n[air]\nhaze = {}\n", haze)));
  EXPECT_THAT(scene_reference(),
              HasSubstr(fmt::format("| `haze` | a number; 0 … 1 | `{}` |", haze)));
  const std::string schema = scene_json_schema();
  const std::size_t at = schema.find("\"haze\"");
  ASSERT_NE(at, std::string::npos);
  EXPECT_THAT(schema.substr(at, 300), HasSubstr(fmt::format("\"default\": {}", haze)));
}

TEST(SceneTable, NamesEachSectionAndKeyOnce) {
  std::map<std::string, int> names;
  for (const SceneSection& section : scene_sections()) {
    ++names[std::string(section.name)];
    for (const SceneKey& key : section.keys) ++names[join_key(section.name, key.name)];
  }
  for (const auto& [name, count] : names) EXPECT_EQ(count, 1) << name;
}

// Code below the scene names its own fields in messages; the scene's keys are prefixed above it.
TEST(SceneTable, LowerLayersDoNotSpeakSceneKeys) {
  std::vector<std::string> keys;
  for (const SceneSection& section : scene_sections()) {
    if (section.name.find('.') != std::string_view::npos) keys.emplace_back(section.name);
    for (const SceneKey& key : section.keys)
      if (!section.name.empty()) keys.push_back(join_key(section.name, key.name));
  }
  ASSERT_GT(keys.size(), 100U);
  int files = 0;
  for (const char* folder :
       {"base", "terrain", "texture", "renderer/image", "renderer/trace", "renderer/paint"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(test::source_folder() + "/" + folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
      ++files;
      std::ifstream source(entry.path());
      for (std::string line; std::getline(source, line);) {
        if (line.starts_with("#include")) continue;
        // The text between quotes.
        bool quoted = false;
        std::string text;
        for (std::size_t i = 0; i < line.size(); ++i)
          if (line[i] == '"' && (i == 0 || line[i - 1] != '\\')) {
            quoted = !quoted;
            text += ' ';
          } else if (quoted) {
            text += line[i];
          }
        for (const std::string& key : keys)
          EXPECT_EQ(text.find(key), std::string::npos)
              << entry.path() << ": " << key << " in " << line;
      }
    }
  EXPECT_GT(files, 200);
}

TEST(SceneTable, WaterHasItsKeys) {
  const LoadedScene loaded = parse_scene(
      "version = 1\n[season]\nfrozen_lakes = \"always\"\n[water]\nmirror = "
      "\"column\"\nmirror_share = 0.5\nwind = 2\nbeds = false\n"
      "surf_mm = 0\nfoam = false\n",
      "w.toml", ".", {});
  const WaterParameters& water = loaded.scene.water;
  EXPECT_EQ(loaded.scene.season.frozen_lakes, "always");
  EXPECT_EQ(water.mirror, "column");
  EXPECT_EQ(water.mirror_share, 0.5);
  EXPECT_EQ(water.wind, 2.0);
  EXPECT_FALSE(water.beds);
  EXPECT_EQ(water.surf_mm, 0.0);
  EXPECT_FALSE(water.foam);
  for (const char* wrong : {"[water]\nmirror = \"glass\"\n", "[water]\nwind = 3\n",
                            "[season]\nfrozen_lakes = \"yes\"\n"})
    EXPECT_THROW(parse_scene(std::string("version = 1\n") + wrong, "w.toml", ".", {}), Error)
        << wrong;
}

TEST(SceneTable, LocalLightHasItsKeys) {
  const LoadedScene loaded = parse_scene(
      "version = 1\n[[light.regions]]\nname = \"a\"\nposition = [10, 20]\nradius_m = 30\nturn_deg "
      "= -40\naltitude_deg = 50\n"
      "strength = 0.6\nwarmth = -0.7\nblend_m = 80\n[[light.regions]]\npoints_lonlat = [[1, 2], "
      "[3, 4], [5, 7]]\nazimuth_deg = 9\n"
      "[[light.regions]]\nfile = \"r.gpkg\"\nlayer = \"l\"\nwhere = \"x = 1\"\norigin = "
      "\"o\"\nlicence = \"c\"\nget_from = \"g\"\n"
      "optional = true\n[[light.clouds]]\nposition_lonlat = [11, 47]\nradius_m = 120\nstrength = "
      "0.3\nblend_m = 140\n",
      "l.toml", ".", {});
  ASSERT_EQ(loaded.scene.light_regions.size(), 3U);
  const SceneLightRegion& circle = loaded.scene.light_regions[0];
  EXPECT_EQ(circle.name, "a");
  EXPECT_EQ(circle.position, glm::dvec2(10.0, 20.0));
  EXPECT_EQ(circle.radius_m, 30.0);
  EXPECT_EQ(circle.turn_deg, -40.0);
  EXPECT_EQ(circle.altitude_deg, 50.0);
  EXPECT_EQ(std::tuple(circle.strength, circle.warmth, circle.blend_m),
            std::tuple(0.6, -0.7, 80.0));
  const SceneLightRegion& outline = loaded.scene.light_regions[1];
  EXPECT_THAT(outline.points_lonlat,
              testing::ElementsAre(glm::dvec2(1, 2), glm::dvec2(3, 4), glm::dvec2(5, 7)));
  EXPECT_EQ(outline.azimuth_deg, 9.0);
  EXPECT_FALSE(outline.optional || outline.turn_deg || outline.altitude_deg);
  const SceneLightRegion& file = loaded.scene.light_regions[2];
  EXPECT_EQ(std::tie(file.file, file.layer, file.where, file.origin, file.licence, file.get_from),
            std::tuple("r.gpkg", "l", "x = 1", "o", "c", "g"));
  EXPECT_TRUE(file.optional);
  ASSERT_EQ(loaded.scene.light_clouds.size(), 1U);
  const SceneLightCloud& cloud = loaded.scene.light_clouds[0];
  EXPECT_EQ(cloud.position_lonlat, glm::dvec2(11.0, 47.0));
  EXPECT_EQ(std::tuple(cloud.radius_m, cloud.strength), std::tuple(120.0, 0.3));
  EXPECT_EQ(cloud.blend_m, 140.0);
  const std::string position = "position = [1, 1]\nradius_m = 20\n";
  for (const char* wrong : {"strength = 2.1\n", "warmth = -1.1\n", "turn_deg = 181\n",
                            "altitude_deg = 0\n", "blend_m = -1\n", "sun = 1\n"})
    EXPECT_THROW(
        parse_scene("version = 1\n[[light.regions]]\n" + position + wrong, "l.toml", ".", {}),
        Error)
        << wrong;
  EXPECT_THROW(parse_scene("version = 1\n[[light.clouds]]\n" + position + "strength = 1.1\n",
                           "l.toml", ".", {}),
               Error);
}

}  // namespace
}  // namespace belvedere
