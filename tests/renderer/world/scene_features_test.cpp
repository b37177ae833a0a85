#include "renderer/world/scene_features.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "renderer/image/exr/compositing_file.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/stages/picture_layers.h"
#include "renderer/world/world.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"
#include "tests/shared_cache.h"

namespace belvedere {
namespace {

using test::Notes;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

// Rolling ground of 8 × 8 km with its own coordinate system, and a forest on all of it.
class SceneFeaturesInPictures : public testing::Test {
 protected:
  SceneFeaturesInPictures() {
    std::string dem = "ncols 80\nnrows 80\nxllcorner 680000\nyllcorner 5240000\ncellsize 100\n";
    for (const auto [x, y] : test::cells(80, 80))
      dem += fmt::format("{:.1f}{}", 900.0 + 60.0 * std::sin(x / 6.0) * std::cos(y / 7.0),
                         x == 79 ? '\n' : ' ');
    folder_.write("dem.asc", dem);
  }
  std::string write(const std::string& name, const std::string& features) const {
    return folder_.write(name,
                         "{\"type\": \"FeatureCollection\", \"crs\": {\"type\": \"name\", "
                         "\"properties\": {\"name\": \"EPSG:32632\"}}, \"features\": [" +
                             features + "]}");
  }
  static std::string line(const std::string& kind, const std::string& positions) {
    return fmt::format(
        "{{\"type\": \"Feature\", \"properties\": {{\"kind\": \"{}\"}}, \"geometry\": {{\"type\": "
        "\"LineString\", \"coordinates\": "
        "[{}]}}}}",
        kind, positions);
  }
  LoadedScene scene(const std::string& features = "", int width = 240, int height = 160) const {
    return parse_scene(fmt::format(R"(version = 1
[[terrain.sources]]
file = "dem.asc"
crs = "EPSG:32632"
[camera]
position = [684000, 5236000]
height_m = 4000
azimuth_deg = 0
pitch_deg = -32
[deform]
exaggeration = 1
[deform.bend]
radius_m = 0
[sun]
azimuth_deg = 315
altitude_deg = 30
[generalize]
foreground_to_m = 32000
background_from_m = 90000
[air]
from_m = 34000
scale_m = 62000
rim_fade_m = 4000
[sampling]
pixel_samples = 1
shadow_rays = 1
sky_directions = 0
[synthesis]
enabled = false
[output]
width = {}
height = {}
sheet_width_mm = 120
formats = ["tif"]
{})",
                                   width, height, features),
                       "features.toml", folder_.path(), {});
  }
  static constexpr const char* block =
      "[[features]]\nsource = \"roads.geojson\"\nkind_of = \"kind\"\n";
  Grid<glm::vec3> painted(const LoadedScene& loaded, const std::string& name,
                          const SheetRequest& request = {}) const {
    render(loaded, folder_ / name, {.cache = test::shared_cache()}, request);
    return read_picture(folder_ / (name + "/panorama.tif"));
  }
  test::Folder folder_;
};

TEST_F(SceneFeaturesInPictures, AnyPartShowsTheWholeAndFarFromThemNothingChanges) {
  write("roads.geojson", line("motorway", "[682500, 5243000], [685500, 5244500]") + "," +
                             line("lift", "[683000, 5242000], [684500, 5243500]") + "," +
                             line("run_easy", "[684600, 5243600], [683400, 5242200]"));
  const Grid<glm::vec3> whole = painted(scene(block), "whole");
  SheetRequest request;
  request.part = PixelRect{70, 50, 190, 141};
  const Grid<glm::vec3> part = painted(scene(block), "part", request);
  ASSERT_EQ(part.width(), 120);
  std::size_t wrong = 0;
  for (const auto [x, y] : test::cells(part)) wrong += part(x, y) != whole(70 + x, 50 + y) ? 1 : 0;
  EXPECT_EQ(wrong, 0U);

  const Grid<glm::vec3> before = painted(scene(), "before");
  World world = make_world(scene(), silent_progress());
  const GroundSight sight(world.dem->transform, *world.surface, *world.camera, world.tracer,
                          world.terrain.goes_to);
  glm::dvec2 low(1e9);
  glm::dvec2 high(-1e9);
  for (const glm::dvec2 position : {glm::dvec2(682500, 5243000), glm::dvec2(685500, 5244500),
                                    glm::dvec2(683000, 5242000), glm::dvec2(684500, 5243600)}) {
    const glm::dvec2 pixel = *sight.pixel(*sight.ground(position));
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  std::size_t changed = 0;
  std::size_t changed_far = 0;
  for (const auto [x, y] : test::cells(before)) {
    if (before(x, y) == whole(x, y)) continue;
    ++changed;
    // Trees are about 20 units high: cleared ones may have reached this far.
    const bool far = x < low.x - 25 || y < low.y - 40 || x > high.x + 25 || y > high.y + 25;
    changed_far += far ? 1 : 0;
  }
  EXPECT_GT(changed, 300U);
  EXPECT_EQ(changed_far, 0U);
}

// Compositing programs select features by the name of their kind, also without the painting.
TEST_F(SceneFeaturesInPictures, AreMasksForBlender) {
  write("roads.geojson", line("motorway", "[682500, 5243000], [685500, 5244500]") + "," +
                             line("lift", "[683000, 5242000], [684500, 5243500]"));
  const auto mask = [&](const std::string& name, SheetRequest request) {
    request.channels = {{"blender"}};
    render(scene(block), folder_ / name, {.cache = test::shared_cache()}, request);
    const std::string file = folder_ / (name + "/guidance.exr");
    return std::pair(read_channel(file, "ViewLayer.CryptoFeature00.r"),
                     read_channel(file, "ViewLayer.CryptoFeature00.g"));
  };
  const auto [id, share] = mask("whole", {.panorama = false});
  double motorway = 0.0;
  double lift = 0.0;
  for (std::size_t i = 0; i < id.size(); ++i) {
    EXPECT_EQ(id[i] == 0.F, share[i] == 0.F);
    if (id[i] == cryptomatte_id("motorway")) motorway += share[i];
    if (id[i] == cryptomatte_id("lift")) lift += share[i];
  }
  EXPECT_GT(motorway, 50.0);
  EXPECT_GT(lift, 10.0);
  const PixelRect part{70, 50, 190, 141};
  const auto [part_id, part_share] = mask("part", {.part = part, .piece_px = 64});
  EXPECT_EQ(part_id, part_of(id, part));
  EXPECT_EQ(part_share, part_of(share, part));
}

// Means of the composite of the layers, which must equal the panorama.
struct LaidLayers {
  double mist = 0.0;
  double features = 0.0;
  double edges = 0.0;
};
LaidLayers lay_layers(const std::string& folder, bool with_mist) {
  const Grid<glm::vec3> picture = read_picture(folder + "/panorama.tif");
  EXPECT_EQ(std::system(("cd " + folder + " && python3 -m zipfile -e panorama.ora layers").c_str()),
            0);
  Grid<glm::vec3> flat(picture.width(), picture.height(), glm::vec3(0.F));
  LaidLayers laid;
  for (const PictureLayer& layer : picture_layers()) {
    if (layer.mask || (layer.of == LayerOf::mist && !with_mist)) continue;
    Grid<float> share;
    const Grid<glm::vec3> colour =
        read_picture(folder + "/layers/data/" + layer.name + ".png", &share);
    for (std::size_t i = 0; i < flat.size(); ++i) {
      flat[i] += share[i] * (colour[i] - flat[i]);
      if (layer.of == LayerOf::mist) laid.mist += share[i];
      if (layer.of == LayerOf::features) laid.features += share[i];
      if (layer.name == "edges") laid.edges += share[i];
    }
  }
  std::size_t off = 0;
  for (std::size_t i = 0; i < flat.size(); ++i)
    for (int c = 0; c < 3; ++c) off += std::abs(flat[i][c] - picture[i][c]) > 6.0 / 65535.0 ? 1 : 0;
  EXPECT_EQ(off, 0U);
  for (double* sum : {&laid.mist, &laid.features, &laid.edges})
    *sum /= static_cast<double>(flat.size());
  return laid;
}

// Roads and lifts can be moved or repainted alone: where their layer is empty the picture is that
// of the others. In mist they are as faint as in the picture, and mist is a layer of its own below.
TEST_F(SceneFeaturesInPictures, TheyAndMistAreLayersOfTheirOwn) {
  write("roads.geojson", line("motorway", "[682500, 5243000], [685500, 5244500]") + "," +
                             line("lift", "[683000, 5242000], [684500, 5243500]"));
  painted(scene(block), "clear", {.layers = {"ora"}});
  const LaidLayers clear = lay_layers(folder_ / "clear", false);
  EXPECT_GT(clear.features, 0.005);
  EXPECT_LT(clear.edges, 0.1) << "layers say nearly all of it";
  painted(scene(std::string(block) +
                "[[air.mist]]\nkind = \"sea\"\nto_m = 980\nvisibility_m = 500\nbillows = 0.2\n"),
          "misty", {.layers = {"ora"}});
  const LaidLayers misty = lay_layers(folder_ / "misty", true);
  EXPECT_GT(misty.mist, 0.1);
  EXPECT_LT(misty.features, 0.8 * clear.features);
  EXPECT_GT(misty.features, 0.1 * clear.features);
  EXPECT_LT(misty.edges, clear.edges + 0.002) << "nothing of mist over a road is told by edges";
}

TEST_F(SceneFeaturesInPictures, ABlockThatIsOffIsAsIfItWereNotThere) {
  write("roads.geojson", line("motorway", "[682500, 5243000], [685500, 5244500]") + "," +
                             line("river", "[683000, 5242000], [684500, 5243500]"));
  const Grid<glm::vec3> bare = painted(scene("", 120, 80), "bare");
  EXPECT_FALSE(painted(scene(block, 120, 80), "on") == bare);
  EXPECT_TRUE(painted(scene(std::string(block) + "enabled = false\n", 120, 80), "off") == bare);
}

TEST_F(SceneFeaturesInPictures, AFileWhoseFeaturesAllLieElsewhereIsSaidWithBothExtents) {
  write("roads.geojson", line("road", "[482500, 5243000], [485500, 5244500]"));
  const LoadedScene loaded = scene(block);
  const World world = make_world(loaded, silent_progress());
  EXPECT_THAT(
      test::usage_error([&] { draw_scene_features(loaded, world, false, silent_progress()); }),
      AllOf(HasSubstr("none of 1 features"), HasSubstr("E 482500 … 485500"),
            HasSubstr("E 680000 … 688000")));
}

TEST_F(SceneFeaturesInPictures, WhatIsLeftOutIsNoted) {
  write("roads.geojson", line("road", "[682500, 5243000], [685500, 5244500]") + "," +
                             line("runway", "[682500, 5243000], [685500, 5244500]") + "," +
                             line("house", "[682500, 5243000], [685500, 5244500]"));
  Notes notes;
  const LoadedScene loaded =
      scene(std::string(block) +
            "[[features]]\nsource = \"none.gpkg\"\nkind = \"road\"\noptional = true\n");
  const FeatureSet set = read_scene_features(loaded, "EPSG:32632", notes);
  EXPECT_EQ(set.features.size(), 1U);
  EXPECT_EQ(set.readings.size(), 1U);
  EXPECT_THAT(notes.all, Contains(AllOf(HasSubstr("\"runway\""), HasSubstr("of a geometry type"))));
  EXPECT_THAT(notes.all, Contains(HasSubstr("none.gpkg is left out")));
  EXPECT_TRUE(read_scene_features(scene(), "", notes).features.empty())
      << "a scene without features asks for no coordinate system";
}

}  // namespace
}  // namespace belvedere
