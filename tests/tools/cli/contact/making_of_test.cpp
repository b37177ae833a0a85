#include "tools/cli/contact/making_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/land_cover_class.h"
#include "renderer/image/image_io.h"
#include "terrain/io/raster_io.h"
#include "tests/tools/cli/contact/contact_scene.h"
#include "tests/tools/program.h"

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
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x)
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
  const Outcome made = run({"figure", file, "--quiet", "--making", "--out", path("out")});
  ASSERT_EQ(made.status, 0) << made.err;
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
  for (int y = 0; y < sheet.height(); ++y)
    for (int x = 0; x < sheet.width(); ++x)
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

}  // namespace
}  // namespace belvedere
