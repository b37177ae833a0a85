#include "renderer/live/live_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/grid.h"
#include "base/random.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/world/world.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/pipeline/painted_scene.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using testing::IsEmpty;

const std::vector<std::string> tiny = {"terrain.synthetic.width=30",
                                       "terrain.synthetic.height=28",
                                       "terrain.synthetic.cell_m=400",
                                       "output.width=48",
                                       "output.height=40",
                                       "output.sheet_width_mm=48"};

LoadedScene tiny_scene(std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(), tiny.begin(), tiny.end());
  settings.insert(settings.begin(), "synthesis.enabled=false");
  return test::small_scene(settings);
}

// Which channels of `seen` are promised.
void expect_same_picture(const LivePicture& a, const LivePicture& b) {
  EXPECT_TRUE(a.colour == b.colour);
  EXPECT_TRUE(a.seen.depth_m == b.seen.depth_m);
  EXPECT_TRUE(a.seen.position_m == b.seen.position_m);
  EXPECT_TRUE(a.seen.altitude_m == b.seen.altitude_m);
  EXPECT_TRUE(a.seen.land_cover == b.seen.land_cover);
  EXPECT_EQ(a.seen.origin_m, b.seen.origin_m);
  EXPECT_EQ(a.view.camera.eye, b.view.camera.eye);
  EXPECT_EQ(a.crs, b.crs);
}

TEST(LiveView, PicturesOfEveryRungAreThoseOfAFreshOneAfterEachChange) {
  const std::vector<std::string> changes = {
      "sun.azimuth_deg=200",
      "camera.azimuth_deg=15",
      "camera.position=[5000, -4000]",
      "deform.exaggeration=1.4",
      "deform.bend.radius_m=60000",
      "deform.handles=[{ position = [6000, 5000], radius_m = 3000, raise_m = 400 }]",
      "generalize.foreground=[1, 1.3, 1, 0.6, 0, 0]",
      "land_cover.settings.treeline_m=1000",
      "season.date=\"02-01\"",
      "palette=winter",
      "air.haze=0.4",
      "seed=5"};
  LiveView live;
  std::vector<std::string> settings;
  for (std::size_t i = 0; i <= changes.size(); ++i) {
    const LoadedScene scene = tiny_scene(settings);
    // The rungs in turn, so that values of several changes before are kept; at last each.
    const bool all = i == changes.size();
    for (std::size_t k = all ? 0 : i % rungs().size(); k < rungs().size();
         k += all ? 1 : rungs().size()) {
      SCOPED_TRACE((i == 0 ? "at first" : "after " + changes[i - 1]) + ", " + rungs()[k].name);
      expect_same_picture(live.paint(scene, rungs()[k], {}),
                          LiveView().paint(scene, rungs()[k], {}));
      ASSERT_FALSE(testing::Test::HasFailure());
    }
    if (i < changes.size()) settings.push_back(changes[i]);
  }
}

// ---- the last rung is what `render` makes

void expect_as_rendered(const LoadedScene& scene) {
  const test::Folder out("out");
  render(scene, out.path(), {.threads = 1});
  const Grid<glm::vec3> rendered = read_picture(out / "panorama.png");
  LiveView live;
  live.paint(scene, rungs().front(), {});
  const LivePicture last = live.paint(scene, rungs().back(), {});
  write_png8(out / "live.png", last.colour, {});
  EXPECT_TRUE(read_picture(out / "live.png") == rendered);
  // Also in tiles, of which the sheet has several.
  const LivePicture tiled =
      LiveView().paint(scene, rungs().back(), {}, [](PixelRect, const Grid<glm::vec3>&) {});
  EXPECT_TRUE(tiled.colour == last.colour);
}

TEST(LiveView, ItsLastRungIsThePanoramaThatRenderMakes) {
  expect_as_rendered(tiny_scene({"output.width=300", "output.height=60", "sampling.pixel_samples=4",
                                 "output.formats=[\"png\"]"}));
}

TEST(LiveView, SoItIsWhereGroundIsCopiedFromAPainting) {
  const test::Folder folder;
  test::write_painting(folder);
  std::vector<std::string> settings = tiny;
  settings.emplace_back("output.formats=[\"png\"]");
  const LoadedScene scene = test::painted_scene(folder, settings);
  ASSERT_TRUE(scene.scene.copies());
  expect_as_rendered(scene);
  std::vector<std::string> plain = settings;
  plain.emplace_back("synthesis.enabled=false");
  LiveView live;
  EXPECT_FALSE(live.paint(scene, rungs().back(), {}).colour ==
               live.paint(test::painted_scene(folder, plain), rungs().back(), {}).colour)
      << "the painting is seen";
}

// ---- the ladder shows one picture

double mean_difference(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c) sum += std::abs(a[i][c] - b[i][c]);
  return sum / (3.0 * static_cast<double>(a.size()));
}

TEST(LiveView, QuickPicturesLookLikeTheLast) {
  const LoadedScene scene = tiny_scene();
  LiveView live;
  const Grid<glm::vec3> last = live.paint(scene, rungs().back(), {}).colour;
  double before = 0.08;
  for (const Rung& rung : rungs()) {
    const double off = mean_difference(live.paint(scene, rung, {}).colour, last);
    EXPECT_LE(off, before) << rung.name;
    before = std::max(off, 1e-9);
  }
  EXPECT_EQ(before, 1e-9);
}

TEST(LiveView, PicturesHaveTheSizeOfTheirRung) {
  const LoadedScene scene = tiny_scene({"output.width=600", "output.height=100"});
  const LivePicture first = LiveView().paint(scene, rungs().front(), {});
  EXPECT_EQ(first.colour.width(), 360);
  EXPECT_EQ(first.colour.height(), 60);
  EXPECT_EQ(first.seen.width(), 360);
  EXPECT_EQ(first.seen.height(), 60);
}

// ---- tiles

TEST(LiveView, TilesCoverThePictureOnceFromTheMiddleAndEqualTheWhole) {
  const LoadedScene scene = tiny_scene({"output.width=600", "output.height=270"});
  const Rung rung{.name = "tiles", .without = {"strokes"}, .strokes = false};
  LiveView live;
  const Grid<glm::vec3> whole = live.paint(scene, rung, {}).colour;
  std::vector<PixelRect> rects;
  Grid<int> count(600, 270, 0);
  const LivePicture tiled =
      live.paint(scene, rung, {}, [&](PixelRect rect, const Grid<glm::vec3>& colour) {
        rects.push_back(rect);
        EXPECT_TRUE(colour == part_of(whole, rect));
        for (const auto [x, y] : test::cells(rect)) ++count(x, y);
      });
  EXPECT_TRUE(tiled.colour == whole);
  for (const int n : count) ASSERT_EQ(n, 1);
  ASSERT_EQ(rects.size(), 6U);
  const auto distance = [](const PixelRect& rect) {
    return std::hypot(0.5 * (rect.x0 + rect.x1) - 300.0, 0.5 * (rect.y0 + rect.y1) - 135.0);
  };
  for (std::size_t i = 1; i < rects.size(); ++i)
    EXPECT_LE(distance(rects[i - 1]), distance(rects[i]));
}

// ---- what a pixel shows

TEST(LiveView, SeenHasThePositionUnderAPixel) {
  const LoadedScene scene = tiny_scene();
  const LivePicture picture = LiveView().paint(scene, rungs().front(), {});
  const World world = make_world(scene, silent_progress());
  int ground = 0;
  for (const auto [x, y] : test::cells({1, 1, 48, 40}, 3)) {
    const std::size_t i = picture.seen.depth_m.index(x, y);
    if (std::isinf(picture.seen.depth_m[i])) continue;
    ++ground;
    const glm::dvec3 at = glm::dvec3(picture.seen.position_m[i]) + picture.seen.origin_m;
    const auto seen_at = world.camera->project(world.deformation.point(at));
    ASSERT_TRUE(seen_at);
    EXPECT_NEAR(seen_at->x, x + 0.5, 1.0);
    EXPECT_NEAR(seen_at->y, y + 0.5, 1.0);
    EXPECT_NEAR(glm::length(at - picture.view.camera.eye), picture.seen.depth_m[i],
                0.03 * picture.seen.depth_m[i]);
  }
  EXPECT_GT(ground, 50);
}

TEST(LiveView, TheGroundOfMapsIsThatOfTheQuickestRung) {
  const LoadedScene scene = tiny_scene({"camera.azimuth_deg=30"});
  LiveView live;
  const LiveView::Ground before = live.ground(scene, {});
  const LivePicture picture = live.paint(scene, rungs().front(), {});
  const LiveView::Ground after = live.ground(scene, {});
  EXPECT_EQ(before.dem, after.dem) << "made once";
  EXPECT_EQ(before.generalized_m, after.generalized_m);
  EXPECT_EQ(after.view.camera.azimuth_deg, picture.view.camera.azimuth_deg);
  EXPECT_TRUE(after.generalized_m->same_size(after.dem->altitude_m));
}

// ---- cancelled

struct Interrupting : Progress {
  explicit Interrupting(int most) : left(most) {}
  void begin(std::string_view, double) override { advance(0.0); }
  void advance(double) override {
    ++told;
    if (left-- <= 0) throw Error(ErrorKind::interrupted, "picture", "cancelled");
  }
  std::atomic<int> left;
  std::atomic<int> told = 0;
};

TEST(LiveView, AfterACancelledPictureTheNextIsRight) {
  const LoadedScene one = tiny_scene();
  const LoadedScene other =
      tiny_scene({"season.date=\"02-01\"", "deform.exaggeration=1.4",
                  "generalize.foreground=[1, 1.3, 1, 0.6, 0, 0]", "terrain.synthetic.seed=9"});
  for (const std::size_t k : {std::size_t{0}, rungs().size() - 1}) {
    const Rung& rung = rungs()[k];
    const int moments = k == 0 ? 20 : 6;
    const LivePicture right = LiveView().paint(one, rung, {});
    Interrupting never(1000000);
    LiveView().paint(other, rung, {.progress = never});
    ASSERT_GT(never.told, 3) << "the picture asks whether to go on";
    LiveView live;
    int ended = 0;
    for (int i = 0; i < moments; ++i) {
      Interrupting progress(never.told * i / moments);
      try {
        live.paint(other, rung, {.progress = progress});
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::interrupted);
        ++ended;
      }
      if (k == 0 ? i % 2 == 0 : i % 3 == 0) expect_same_picture(live.paint(one, rung, {}), right);
      ASSERT_FALSE(testing::Test::HasFailure()) << rung.name << ", moment " << i;
    }
    EXPECT_GT(ended, moments / 2);
  }
}

TEST(LiveView, ItsLastRungRefusesWhatRenderRefuses) {
  const LoadedScene scene =
      test::small_scene({"exemplar.0={ picture = \"none.png\", classes = \"none.png\" }"});
  LiveView live;
  EXPECT_EQ(test::error_of([&] { live.paint(scene, rungs().back(), {}); }).kind(),
            ErrorKind::input);
  live.paint(tiny_scene(), rungs().front(), {});
}

// A scene of a file, whose ground unlike synthetic terrain has coarser levels.
LoadedScene file_scene(const std::vector<std::string>& settings = {}) {
  return parse_scene(
      "version = 1\n[[terrain.sources]]\nfile = \"a.tif\"\n[camera]\nposition = [0, 0]\n[output]\n"
      "width = 3000\nheight = 1200\n",
      "a.toml", ".", {.data_folders = {}, .settings = settings});
}

TEST(Rungs, EachHasMoreThanTheOneBefore) {
  ASSERT_GE(rungs().size(), 2U);
  for (std::size_t i = 1; i < rungs().size(); ++i) {
    const Rung& before = rungs()[i - 1];
    const Rung& rung = rungs()[i];
    EXPECT_GE(rung.max_width_px, before.max_width_px);
    EXPECT_GE(rung.strokes, before.strokes);
    EXPECT_LE(rung.without.size(), before.without.size());
    EXPECT_NE(rung.name, before.name);
  }
}

TEST(Rungs, OnlyTheLastLacksNothing) {
  for (const Rung& rung : rungs()) EXPECT_EQ(rung.is_last(), &rung == &rungs().back()) << rung.name;
  EXPECT_TRUE(rungs().back().strokes);
}

// What a rung leaves out is said, so that nobody takes its picture for the finished one.
TEST(Rungs, SayWhatTheyLeaveOut) {
  for (const Rung& rung : rungs()) {
    const auto says = [&](const char* words) {
      return std::find(rung.without.begin(), rung.without.end(), words) != rung.without.end();
    };
    EXPECT_EQ(says("strokes"), !rung.strokes) << rung.name;
    EXPECT_EQ(says("rock relief"), !rung.strokes) << rung.name;
  }
}

TEST(Rungs, LackMistAndFeaturesWhereTheSceneHasThem) {
  LoadedScene scene = test::small_scene();
  for (const Rung& rung : rungs()) EXPECT_EQ(lacks_of(scene, rung), rung.without) << rung.name;
  scene.scene.air.mist.emplace_back();
  scene.scene.features.emplace_back();
  for (const Rung& rung : rungs()) {
    std::vector<std::string> all = rung.without;
    if (!rung.strokes) all.insert(all.end(), {"mist", "features"});
    EXPECT_EQ(lacks_of(scene, rung), all) << rung.name;
  }
}

TEST(Rungs, TheLastDrawsTheSceneAsItIs) {
  for (const LoadedScene& scene :
       {test::small_scene(), file_scene({"output.width=800", "output.height=320"})}) {
    const LoadedScene drawn = scene_of_rung(scene, rungs().back());
    EXPECT_EQ(write_scene(drawn.scene), write_scene(scene.scene));
    EXPECT_EQ(drawn.folder, scene.folder);
  }
}

TEST(Rungs, LargeSheetsAreDrawnSmallerInTheirShape) {
  const Scene drawn =
      scene_of_rung(file_scene(), {.name = {}, .without = {}, .max_width_px = 400}).scene;
  EXPECT_EQ(drawn.output.width, 400);
  EXPECT_EQ(drawn.output.height, 160);
  EXPECT_EQ(drawn.output.sheet_width_mm, file_scene().scene.output.sheet_width_mm)
      << "strokes keep their size on the sheet";
  const Scene small =
      scene_of_rung(test::small_scene(), {.name = {}, .without = {}, .max_width_px = 400}).scene;
  EXPECT_EQ(small.output.width, 96) << "none is drawn larger";
  EXPECT_EQ(small.output.height, 80);
  const Scene flat = scene_of_rung(file_scene({"output.height=20"}),
                                   {.name = {}, .without = {}, .max_width_px = 100})
                         .scene;
  EXPECT_EQ(flat.output.height, 16) << "the smallest picture there is";
}

TEST(Rungs, PreviewsHaveFewRaysAndCoarseGroundAndCopyNothing) {
  const LoadedScene scene =
      test::small_scene({"sampling.pixel_samples=9", "sampling.shadow_rays=6",
                         "sampling.sky_directions=24", "synthesis.enabled=true"});
  const Scene drawn = scene_of_rung(scene, rungs().front()).scene;
  EXPECT_EQ(drawn.sampling.pixel_samples, 1);
  EXPECT_EQ(drawn.sampling.shadow_rays, 1);
  EXPECT_EQ(drawn.sampling.sky_directions, 4);
  EXPECT_EQ(drawn.water.mirror, "column");
  EXPECT_FALSE(drawn.copies());
  EXPECT_EQ(
      scene_of_rung(test::small_scene({"water.mirror=none"}), rungs().front()).scene.water.mirror,
      "none");
  EXPECT_EQ(drawn.terrain.preview_mcells, 1.0);
}

}  // namespace
}  // namespace belvedere
