#include "renderer/pipeline/pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/common.hpp>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/random.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"
#include "tests/paths.h"
#include "tests/renderer/image/picture_bytes.h"
#include "tests/shared_cache.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using test::read_bytes;

// A small end-to-end case: synthetic terrain, painted sheet, synthesis, strokes, files.
constexpr const char* small_scene = R"(
version = 1
[terrain.synthetic]
width = 200
height = 220
cell_m = 90
seed = 3
[deform]
exaggeration = 1.5
[camera]
position = [9000, -6000]
height_m = 9000
pitch_deg = -22
[sun]
azimuth_deg = 235
[[exemplar]]
width = 240
height = 180
[output]
width = 200
height = 120
sheet_width_mm = 150
)";

class Pipeline : public testing::Test {
 protected:
  // One render shared by several tests: on one thread.
  static void SetUpTestSuite() {
    folder_of_all_ = std::make_unique<test::Folder>();
    rendered_ = folder_of_all_->path();
    render(parse_scene(small_scene, "small.toml", ".", {}), rendered_,
           {.threads = 1, .tile_px = 32});
  }
  static void TearDownTestSuite() { folder_of_all_.reset(); }
  static inline std::unique_ptr<test::Folder> folder_of_all_;
  static inline std::string rendered_;

  std::string out(const std::string& name) const { return folder_ / name; }
  LoadedScene scene(const std::vector<std::string>& settings = {}) const {
    return parse_scene(small_scene, "small.toml", folder_.path(),
                       {.data_folders = {}, .settings = settings});
  }
  static void expect_same_files(const std::string& a, const std::string& b) {
    for (const char* file : {"panorama.tif", "panorama.png", "panorama.exr", "guidance.exr"}) {
      const std::string left = read_bytes(a + "/" + file);
      EXPECT_FALSE(left.empty()) << file;
      EXPECT_TRUE(left == read_bytes(b + "/" + file)) << file;
    }
  }

  // A golden picture is small, and was inspected when it was made. A change of the look is meant to
  // fail here: look at the new picture, then run with BELVEDERE_WRITE_GOLDEN=1 and commit it.
  // Thresholds, of 1, allow for another processor's last bits, not for another look: .003 on
  // average over all pixels, and one pixel in a hundred may be .1 off.
  static void expect_golden(const std::string& picture, const std::string& name) {
    const std::string golden = test::source_folder() + "/tests/golden/" + name;
    if (std::getenv("BELVEDERE_WRITE_GOLDEN") != nullptr)
      fs::copy_file(picture, golden, fs::copy_options::overwrite_existing);
    const Grid<glm::vec3> expected = read_picture(golden);
    const Grid<glm::vec3> found = read_picture(picture);
    ASSERT_TRUE(found.same_size(expected));
    double sum = 0.0;
    int far_off = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const glm::vec3 d = glm::abs(found[i] - expected[i]);
      sum += (d.x + d.y + d.z) / 3.0;
      far_off += std::max({d.x, d.y, d.z}) > 0.1F ? 1 : 0;
    }
    EXPECT_LT(sum / static_cast<double>(expected.size()), 0.003);
    EXPECT_LT(far_off, static_cast<int>(expected.size() / 100));
  }

  test::Folder folder_;
};

TEST_F(Pipeline, SameBytesForAnyThreadsAndTiles) {
  render(scene(), out("b"), {.threads = 2, .tile_px = 64});
  expect_same_files(rendered_, out("b"));
}

TEST_F(Pipeline, GuidanceAloneEqualsGuidanceOfTheWholeRender) {
  // Taller than one band of the streamed file, with a margin on both sides of its seams.
  const std::vector<std::string> tall = {"output.height=1100", "output.width=96",
                                         "output.sheet_width_mm=96", "synthesis.enabled=false",
                                         "sampling.pixel_samples=1"};
  render(scene(tall), out("a"), {.cache = test::shared_cache()});
  render(scene(tall), out("b"), {.cache = test::shared_cache()}, {.panorama = false});
  EXPECT_TRUE(read_bytes(out("a/guidance.exr")) == read_bytes(out("b/guidance.exr")));
}

TEST_F(Pipeline, PanoramaShowsSkyOverTerrainAndIsPainted) {
  const Grid<glm::vec3> picture = read_picture(rendered_ + "/panorama.tif");
  const GuidanceBuffers guidance = read_guidance(rendered_ + "/guidance.exr");
  ASSERT_EQ(picture.width(), 200);
  ASSERT_EQ(picture.height(), 120);
  EXPECT_TRUE(guidance.is_sky(guidance.depth_m.index(100, 0)));
  EXPECT_FALSE(guidance.is_sky(guidance.depth_m.index(100, 119)));
  // Sky is bluer than it is red; the ground differs from its strokeless base.
  EXPECT_GT(picture(100, 0).z, picture(100, 0).x + 0.1F);
  double difference = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (guidance.is_sky(i)) continue;
    const double base = std::pow(static_cast<double>(guidance.base[i].y), 1.0 / 2.2);
    difference += std::abs(picture[i].y - base);
    ++count;
  }
  EXPECT_GT(difference / count, 0.01);
  EXPECT_LT(difference / count, 0.12);
}

// A painting in reds, each class lighter to the right: its colours become those of the base
// picture, with or without its strokes.
TEST_F(Pipeline, ColoursOfAPaintingReachTheBasePicture) {
  Grid<glm::vec3> red(88, 40);
  std::string classes;
  for (const auto [x, y] : test::cells(88, 40)) {
    const float light = static_cast<float>(x % 8) / 8.F;
    red(x, y) = glm::vec3(0.3F + 0.6F * light, 0.1F + 0.2F * light, 0.05F);
    classes += static_cast<char>(x / 8 + 1);
  }
  write_png8(out("red.png"), red, {});
  test::write_bytes(out("classes.png"), test::make_png(88, 40, 8, 0, classes));
  const std::string painting =
      "exemplar.0={ picture = \"red.png\", classes = \"classes.png\", stroke_px = 1 }";
  const auto redness = [&](const std::string& colours) {
    render(scene({painting, "synthesis.colours=" + colours, "synthesis.enabled=false", "air.haze=0",
                  "air.range_mist=0", "sampling.pixel_samples=1", "output.width=96",
                  "output.height=64", "output.sheet_width_mm=96"}),
           out(colours), {}, {.panorama = false});
    const GuidanceBuffers guidance = read_guidance(out(colours) + "/guidance.exr");
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < guidance.base.size(); ++i)
      if (!guidance.is_sky(i)) {
        sum += guidance.base[i].x - guidance.base[i].z;
        ++count;
      }
    return sum / count;
  };
  EXPECT_GT(redness("painting"), 0.17);
  EXPECT_LT(redness("palette"), 0.15);
}

// T40: two painters with the same colours, one with level and one with upright strokes: in copies
// of their paint on the same ground, lightness changes more from row to row and from column to
// column.
TEST_F(Pipeline, CopiesOfTwoPaintersAreToldApart) {
  std::string classes;
  for (const auto [x, y] : test::cells(176, 80)) classes += static_cast<char>(x / 16 + 1);
  test::write_bytes(out("classes.png"), test::make_png(176, 80, 8, 0, classes));
  // Mean squared step from row to row over that from column to column, on the ground.
  const auto levelness = [&](const std::string& name, int dot_width, int dot_height) {
    Grid<glm::vec3> painting(176, 80);
    for (const auto [x, y] : test::cells(176, 80))
      painting(x, y) = glm::vec3(
          0.35F + 0.3F * static_cast<float>(random_uniform(5, x / dot_width, y / dot_height)));
    write_png8(out(name + ".png"), painting, {});
    render(scene({"exemplar.0={ picture = \"" + name +
                      ".png\", classes = \"classes.png\", stroke_px = 12 }",
                  "output.width=120", "output.height=80", "output.sheet_width_mm=120"}),
           out(name), {.cache = test::shared_cache()});
    const Grid<glm::vec3> picture = read_picture(out(name) + "/panorama.png");
    const GuidanceBuffers guidance = read_guidance(out(name) + "/guidance.exr");
    double rows = 0.0, columns = 0.0;
    for (const auto [x, y] : test::cells(119, 79)) {
      if (guidance.is_sky(guidance.depth_m.index(x, y))) continue;
      rows += std::pow(static_cast<double>(picture(x, y + 1).y - picture(x, y).y), 2.0);
      columns += std::pow(static_cast<double>(picture(x + 1, y).y - picture(x, y).y), 2.0);
    }
    return rows / columns;
  };
  EXPECT_GT(levelness("level", 8, 1), 1.3 * levelness("upright", 1, 8));
}

TEST_F(Pipeline, LooksAsItDid) { expect_golden(rendered_ + "/panorama.png", "small_panorama.png"); }

// Nearer mountains turned by a handle and raised, a summit stretched, the ground tilted towards the
// viewer: light, land cover and strokes follow.
TEST_F(Pipeline, TurnedMountainLooksAsItDid) {
  constexpr const char* turned = R"(
[synthesis]
enabled = false
[[deform.bend.points]]
distance_m = 5000
inclination_deg = 12
[[deform.bend.points]]
distance_m = 24000
inclination_deg = 0
[[deform.summits]]
position = [13500, 11500]
radius_m = 3000
factor = 1.5
base_m = 900
[[deform.handles]]
position = [8000, 7500]
radius_m = 5500
core_m = 2500
move_m = [0, 400]
rotate_deg = 60
raise_m = 250
)";
  render(parse_scene(std::string(small_scene) + turned, "turned.toml", ".", {}), out("turned"),
         {.cache = test::shared_cache()});
  expect_golden(out("turned/panorama.png"), "turned_mountain.png");
}

TEST_F(Pipeline, EveryFileSaysWhatMadeIt) {
  for (const char* file : {"panorama.tif", "panorama.exr", "guidance.exr"}) {
    const ImageInfo info = read_image_info(rendered_ + "/" + file);
    ASSERT_TRUE(info.notes.contains("belvedere:scene")) << file;
    EXPECT_NE(info.notes.at("belvedere:scene").find("[terrain.synthetic]"), std::string::npos)
        << file;
    EXPECT_TRUE(info.notes.contains("belvedere:camera")) << file;
  }
}

TEST_F(Pipeline, AnOutputThatCannotBeWrittenIsRefusedBeforeTheWork) {
  folder_.write("file", "no folder");
  test::message_of(ErrorKind::output, [&] { render(scene(), out("file") + "/below", {}); });
}

TEST_F(Pipeline, APictureBeyondMemoryIsRefusedWithTheEstimate) {
  const Error error = test::error_of([&] {
    render(scene({"output.width=60000", "output.height=60000"}), out("a"),
           {.memory_bytes = 100U << 20U});
  });
  EXPECT_EQ(error.kind(), ErrorKind::limit);
  EXPECT_NE(std::string(error.what()).find("MiB"), std::string::npos);
}

// The work would begin if the estimate left the ground out.
TEST_F(Pipeline, WhatGroundLeavesIsKnownBeforeTheWork) {
  class NoWork : public Progress {
    void begin(std::string_view stage, double) override {
      throw Error(ErrorKind::bug, "test", "work begins: " + std::string(stage), "");
    }
  } progress;
  const std::vector<std::string> print = {"output.width=20000", "output.height=8000",
                                          "output.sheet_width_mm=1200", "synthesis.enabled=false"};
  const auto kind_of = [&](std::vector<std::string> settings) {
    settings.insert(settings.end(), print.begin(), print.end());
    try {
      render(scene(settings), out("a"), {.memory_bytes = 600U << 20U, .progress = progress});
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::usage;
  };
  EXPECT_EQ(kind_of({}), ErrorKind::bug);
  EXPECT_EQ(kind_of({"terrain.synthetic.width=3000", "terrain.synthetic.height=3000"}),
            ErrorKind::limit);
}

TEST_F(Pipeline, ASunBelowTheHorizonIsNotedAndLeavesSkyLight) {
  struct Notes : Progress {
    std::string all;
    void note(std::string_view text) override { all += text; }
  } notes;
  render(scene({"sun.altitude_deg=-5"}), out("a"),
         {.progress = notes, .cache = test::shared_cache()}, {.panorama = false});
  EXPECT_NE(notes.all.find("below the horizon"), std::string::npos);
  const GuidanceBuffers guidance = read_guidance(out("a/guidance.exr"));
  for (std::size_t i = 0; i < guidance.shadow.size(); ++i)
    if (!guidance.is_sky(i)) {
      ASSERT_EQ(guidance.shadow[i], 0.F);
    }
}

}  // namespace
}  // namespace belvedere
