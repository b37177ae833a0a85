#include "tools/cli/contact/making_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/land_cover_class.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/tools/cli/contact/contact_scene.h"
#include "tests/tools/program.h"

// `belvedere figure` as users meet it.

namespace belvedere {
namespace {

using tools::MakingStep;

class MakingOf : public Program {};

// The stages are those of rendering: the last one is its picture.
TEST_F(MakingOf, ShowsEveryStageAndEndsInThePictureThatRenderingMakes) {
  const std::string bent = std::string(test::contact_scene) + R"(
[generalize]
preset = "panorama"
[deform]
exaggeration = 1.6
[[exemplar]]
width = 240
height = 180
)";
  const std::string file = write("s.toml", bent);
  ASSERT_EQ(run({"render", file, "--quiet", "--out", path("one")}).status, 0);
  ASSERT_EQ(run({"figure", file, "--quiet", "--making", "--out", path("out")}).status, 0);
  const std::vector<std::string> files = {"1_measured", "2_generalized", "3_bent",   "4_classes",
                                          "5_tone",     "6_base",        "7_copied", "8_strokes"};
  std::vector<Grid<glm::vec3>> steps;
  for (const std::string& name : files) {
    steps.push_back(read_picture(path("out/making_" + name + ".png")));
    ASSERT_EQ(steps.back().width(), 120) << name;
    ASSERT_EQ(steps.back().height(), 64) << name;
  }
  for (std::size_t i = 1; i < steps.size(); ++i) EXPECT_NE(steps[i - 1], steps[i]) << files[i];
  EXPECT_EQ(steps.back(), read_picture(path("one/panorama.png")));
  EXPECT_GT(read_picture(path("out/making.png")).height(), 4 * 64);
}

TEST_F(MakingOf, LeavesOutCopyingWhereNothingIsCopiedAndTakesAWidth) {
  const std::string file =
      write("s.toml", std::string(test::contact_scene) + "[synthesis]\nenabled = false\n");
  ASSERT_EQ(
      run({"figure", file, "--quiet", "--making", "--width", "60", "--out", path("out")}).status,
      0);
  EXPECT_EQ(read_picture(path("out/making_7_strokes.png")).width(), 60);
  EXPECT_EQ(read_picture(path("out/picture.png")), read_picture(path("out/making_7_strokes.png")));
  EXPECT_FALSE(std::filesystem::exists(path("out/making_8_strokes.png")));
}

// For ground larger than memory the first stages show the whole at a coarse level, the last the
// result of its windows.
TEST_F(MakingOf, ShowsGroundLargerThanMemory) {
  Raster<float> raster{
      Grid<float>(400, 400), {600000.0, 5200000.0, 30.0, 30.0}, normalize_crs("EPSG:32632")};
  for (const auto [x, y] : test::cells(400, 400))
    raster.cells(x, y) =
        900.F + static_cast<float>((x / 20 + y / 25) % 2) * 300.F + static_cast<float>(400 - y);
  write_raster(path("dem.tif"), raster);
  const std::string file =
      write("s.toml",
            "version = 1\n[[terrain.sources]]\nfile = \"dem.tif\"\n[terrain]\nmax_mcells = 0.06\n"
            "[camera]\nposition = [606000, 5185000]\nheight_m = 4000\npitch_deg = "
            "-24\n[synthesis]\nenabled = false\n"
            "[output]\nwidth = 100\nheight = 60\nsheet_width_mm = 100\n");
  EXPECT_NE(run({"check", file}).out.find("more than memory holds"), std::string::npos);
  ASSERT_EQ(run({"render", file, "--quiet", "--out", path("one")}).status, 0);
  ASSERT_THAT(run({"figure", file, "--quiet", "--making", "--out", path("out")}), Ends(0));
  EXPECT_EQ(read_picture(path("out/making_7_strokes.png")), read_picture(path("one/panorama.png")));
  // The relief shows ground, not an empty sheet: it has light and dark.
  const Grid<glm::vec3> measured = read_picture(path("out/making_1_measured.png"));
  float low = 1.F;
  float high = 0.F;
  for (const glm::vec3& colour : measured) {
    low = std::min(low, colour.g);
    high = std::max(high, colour.g);
  }
  EXPECT_GT(high - low, 0.3F);
}

// Two side by side, in their order from left to right and down.
TEST(DrawMakingOf, LaysStepsOutInPairs) {
  std::vector<MakingStep> steps;
  for (int i = 0; i < 3; ++i)
    steps.push_back(
        {"s", "s", Grid<glm::vec3>(40, 20, glm::vec3(0.25F * static_cast<float>(i), 0.F, 1.F))});
  const Grid<glm::vec3> sheet = tools::draw_making_of(steps, 40);
  std::vector<glm::ivec2> first(3, glm::ivec2(-1));
  for (const auto [x, y] : test::cells(sheet))
    for (std::size_t i = 0; i < 3; ++i)
      if (first[i].x < 0 && sheet(x, y) == steps[i].picture(0, 0)) first[i] = {x, y};
  EXPECT_EQ(first[0].y, first[1].y);
  EXPECT_GE(first[1].x, first[0].x + 40);
  EXPECT_EQ(first[2].x, first[0].x);
  EXPECT_GE(first[2].y, first[0].y + 20);
}

TEST(ClassColour, IsThatOfTheTableAndPaleForWhatIsNoClass) {
  EXPECT_EQ(tools::class_colour(250), tools::no_class_colour);
  EXPECT_NE(tools::class_colour(static_cast<std::uint8_t>(LandCoverClass::water)),
            tools::no_class_colour);
}

const std::string figure_scene = std::string(test::contact_scene) + R"(
[[exemplar]]
width = 240
height = 180
)";

class Figure : public Program {};

// Where a picture lies in a sheet; -1 where it does not.
glm::ivec2 found_in(const Grid<glm::vec3>& sheet, const Grid<glm::vec3>& picture) {
  for (int y0 = 0; y0 + picture.height() <= sheet.height(); ++y0)
    for (int x0 = 0; x0 + picture.width() <= sheet.width(); ++x0) {
      bool same = true;
      for (int y = 0; same && y < picture.height(); ++y)
        same = std::equal(picture.row(y), picture.row(y) + picture.width(), sheet.row(y0 + y) + x0);
      if (same) return {x0, y0};
    }
  return glm::ivec2(-1);
}

TEST_F(Figure, ShowsGuidesOfThePictureAndOfWhatItCopiesFrom) {
  const std::string file = write("s.toml", figure_scene);
  ASSERT_THAT(run({"figure", file, "--quiet", "--out", path("out")}), Ends(0));
  ASSERT_EQ(run({"render", file, "--quiet", "--channels", "Z,landcover.id,altitude.V", "--out",
                 path("one")})
                .status,
            0);
  EXPECT_EQ(read_picture(path("out/picture.png")), read_picture(path("one/panorama.png")));
  const GuidanceBuffers guidance = read_guidance(path("one/guidance.exr"));
  const Grid<glm::vec3> classes = read_picture(path("out/picture_landcover.png"));
  const Grid<glm::vec3> altitude = read_picture(path("out/picture_altitude.png"));
  ASSERT_TRUE(classes.same_size(guidance.land_cover));
  float lowest = 1e9F;
  float highest = 0.F;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (guidance.is_sky(i)) continue;
    const std::uint32_t rgb =
        land_cover_classes()[static_cast<std::size_t>(guidance.land_cover[i])].rgb;
    const auto byte = [](float v) { return static_cast<std::uint32_t>(std::lround(255.F * v)); };
    ASSERT_EQ(byte(classes[i].r) << 16U | byte(classes[i].g) << 8U | byte(classes[i].b), rgb) << i;
    ASSERT_NEAR(255.F * altitude[i].r, guidance.altitude_m[i] / 20.F, 0.51F) << i;  // 20 m a step
    lowest = std::min(lowest, guidance.altitude_m[i]);
    highest = std::max(highest, guidance.altitude_m[i]);
  }
  EXPECT_GT(highest, lowest + 500.F);
  // Distance: black nearest, white farthest of both columns, straight in its logarithm.
  const Grid<glm::vec3> distance = read_picture(path("out/picture_distance.png"));
  std::vector<std::pair<float, float>> by_depth;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (!guidance.is_sky(i))
      by_depth.emplace_back(std::log(std::max(guidance.depth_m[i], 500.F)), distance[i].r);
  const auto [near, far] = std::minmax_element(by_depth.begin(), by_depth.end());
  ASSERT_GT(far->second, near->second + 0.2F);
  const float slope = (far->second - near->second) / (far->first - near->first);
  for (const auto& [log_m, grey] : by_depth)
    ASSERT_NEAR(grey, near->second + slope * (log_m - near->first), 0.04F);
  // The example sheet that texels come from, with the same two.
  for (const char* name : {"out/copied_1.png", "out/copied_1_landcover.png",
                           "out/copied_1_altitude.png", "out/copied_1_distance.png"}) {
    const Grid<glm::vec3> picture = read_picture(path(name));
    EXPECT_EQ(picture.width(), 240) << name;
    EXPECT_EQ(picture.height(), 180) << name;
  }
  const Grid<glm::vec3> sheet = read_picture(path("out/sheet.png"));
  EXPECT_GT(sheet.width(), 360);
  EXPECT_GT(sheet.height(), 3 * 180);
  // Land cover above altitude above distance above paint, what is copied from at the left of the
  // picture.
  const auto corner = [&](const std::string& name) {
    return found_in(sheet, read_picture(path("out/" + name + ".png")));
  };
  for (const std::string column : {"copied_1", "picture"}) {
    const glm::ivec2 cover = corner(column + "_landcover");
    const glm::ivec2 heights = corner(column + "_altitude");
    const glm::ivec2 distances = corner(column + "_distance");
    const glm::ivec2 paint = corner(column);
    ASSERT_TRUE(cover.x >= 0 && heights.x >= 0 && distances.x >= 0 && paint.x >= 0) << column;
    for (const glm::ivec2 other : {heights, distances, paint}) EXPECT_EQ(cover.x, other.x);
    EXPECT_LT(cover.y, heights.y) << column;
    EXPECT_LT(heights.y, distances.y) << column;
    EXPECT_LT(distances.y, paint.y) << column;
  }
  EXPECT_GE(corner("picture").x, corner("copied_1").x + 240);
  // The example sheet's own: classes in their colours, altitudes in grey, paint in neither.
  const auto kinds = [&](const std::string& name) {
    std::size_t grey = 0;
    std::size_t flat = 0;
    const Grid<glm::vec3> picture = read_picture(path("out/" + name + ".png"));
    for (const glm::vec3& colour : picture) {
      grey += colour.r == colour.g && colour.g == colour.b ? 1 : 0;
      flat += std::any_of(land_cover_classes().begin(), land_cover_classes().end(),
                          [&](const LandCoverClassInfo& info) {
                            const auto byte = [](float v) {
                              return static_cast<std::uint32_t>(std::lround(255.F * v));
                            };
                            return info.rgb ==
                                   (byte(colour.r) << 16U | byte(colour.g) << 8U | byte(colour.b));
                          })
                  ? 1
                  : 0;
    }
    const auto share = [&](std::size_t count) {
      return static_cast<double>(count) / static_cast<double>(picture.size());
    };
    return std::pair(share(grey), share(flat));
  };
  const auto [cover_grey, cover_flat] = kinds("copied_1_landcover");
  const auto [heights_grey, heights_flat] = kinds("copied_1_altitude");
  const auto [paint_grey, paint_flat] = kinds("copied_1");
  EXPECT_GT(cover_flat, 0.5);
  EXPECT_LT(paint_flat, 0.1);
  EXPECT_LT(cover_grey, 0.6);
  EXPECT_GT(heights_grey, 0.7);
  EXPECT_LT(paint_grey, 0.5);
  EXPECT_LT(heights_flat, 0.6);
}

// Figure 6: the same viewpoint three times, side by side from left to right. What is local is the
// whole difference of the last two: without it there are only the first two, bit for bit.
TEST_F(Figure, ShowsTheDeformationStepByStep) {
  const std::string bent = std::string(test::contact_scene) +
                           "[deform]\nexaggeration = 1.6\n[deform.bend]\nradius_m = 40000\n";
  const std::string turned =
      "[[deform.handles]]\nposition = [5000, 4500]\nradius_m = 3600\ncore_m = 1200\n"
      "rotate_deg = 50\n";
  const std::string whole = write("whole.toml", bent + turned);
  ASSERT_THAT(run({"figure", whole, "--quiet", "--deformation", "--out", path("a")}), Ends(0));
  const std::vector<std::string> files = {"1_undeformed", "2_progressive", "3_local"};
  const Grid<glm::vec3> sheet = read_picture(path("a/deformation.png"));
  std::vector<Grid<glm::vec3>> steps;
  glm::ivec2 before(-1);
  for (const std::string& name : files) {
    steps.push_back(read_picture(path("a/deformation_" + name + ".png")));
    ASSERT_EQ(steps.back().width(), 120) << name;
    const glm::ivec2 at = found_in(sheet, steps.back());
    ASSERT_GE(at.x, 0) << name;
    if (before.x >= 0) {
      EXPECT_GE(at.x, before.x + 120) << name;
      EXPECT_EQ(at.y, before.y) << name;
    }
    before = at;
  }
  EXPECT_NE(steps[0], steps[1]);
  EXPECT_NE(steps[1], steps[2]);
  EXPECT_FALSE(std::filesystem::exists(path("a/picture.png"))) << "nothing is painted";
  const std::string progressive = write("progressive.toml", bent);
  ASSERT_THAT(run({"figure", progressive, "--quiet", "--deformation", "--out", path("b")}),
              Ends(0));
  EXPECT_EQ(read_picture(path("b/deformation_1_undeformed.png")), steps[0]);
  EXPECT_EQ(read_picture(path("b/deformation_2_progressive.png")), steps[1]);
  EXPECT_FALSE(std::filesystem::exists(path("b/deformation_3_local.png")));
  EXPECT_NE(run({"figure", whole, "--making", "--deformation", "--out", path("c")}).status, 0);
}

}  // namespace
}  // namespace belvedere
