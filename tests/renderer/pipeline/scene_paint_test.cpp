#include "renderer/pipeline/scene_paint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/files.h"
#include "tests/renderer/image/icc/press_profile.h"
#include "tests/renderer/pipeline/painted_scene.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class ScenePaints : public testing::Test {
 protected:
  ScenePaints() { test::write_painting(folder_); }
  LoadedScene scene(const std::vector<std::string>& settings = {}) const {
    return test::painted_scene(folder_, settings);
  }
  void damage() const {
    fs::resize_file(folder_ / "red.png", fs::file_size(folder_ / "red.png") / 2);
  }
  std::string refused(const LoadedScene& loaded) const {
    return test::input_error([&] { require_inputs(loaded); });
  }
  test::Folder folder_;
};

const std::string no_synthesis = "synthesis.enabled=false";
const std::string its_colours = "synthesis.colours=painting";

TEST_F(ScenePaints, InputsThatAreWholePass) {
  for (const std::vector<std::string>& settings :
       {std::vector<std::string>{}, {no_synthesis}, {no_synthesis, its_colours}})
    EXPECT_NO_THROW(require_inputs(scene(settings)));
}

TEST_F(ScenePaints, ADamagedPaintingIsRefusedWhereverItsStrokesOrColoursAreUsed) {
  damage();
  EXPECT_THAT(refused(scene()), HasSubstr("red.png"));
  EXPECT_THAT(refused(scene({its_colours})), HasSubstr("red.png"));
  EXPECT_THAT(refused(scene({no_synthesis, its_colours})), HasSubstr("red.png"))
      << "without its strokes, but in its colours";
  EXPECT_NO_THROW(require_inputs(scene({no_synthesis}))) << "nobody uses it";
}

TEST_F(ScenePaints, AFileThatIsMissingIsRefusedAnyway) {
  fs::remove(folder_ / "red.png");
  EXPECT_THAT(refused(scene()), HasSubstr("exemplar.0.picture"));
  EXPECT_THAT(refused(scene({no_synthesis})), HasSubstr("exemplar.0.picture"));
}

TEST_F(ScenePaints, PaintingsAreReadWhereTheyAreUsed) {
  const auto paintings = [&](const std::vector<std::string>& settings) {
    return read_scene_paint(scene(settings), silent_progress()).paintings;
  };
  EXPECT_THAT(paintings({}), SizeIs(1));
  EXPECT_THAT(paintings({no_synthesis, its_colours}), SizeIs(1));
  EXPECT_THAT(paintings({no_synthesis}), IsEmpty());
}

TEST_F(ScenePaints, ThePaletteIsTheScenesOrThePaintings) {
  const auto forest = [](const Palette& palette) {
    return palette_colour(palette, LandCoverClass::forest, 900.0, 0.6);
  };
  const glm::vec3 own = forest(read_scene_palette(scene(), silent_progress()));
  EXPECT_EQ(own, forest(read_palette("summer")));
  const glm::vec3 painted = forest(read_scene_palette(scene({its_colours}), silent_progress()));
  EXPECT_GT(painted.x, painted.z + 0.2F) << "the painting is red";
  EXPECT_EQ(painted, forest(read_scene_paint(scene({its_colours}), silent_progress()).palette));
  EXPECT_EQ(forest(read_scene_palette(scene({"palette=winter"}), silent_progress())),
            forest(read_palette("winter")));
}

TEST(OutputColour, IsSrgbWhereTheSceneSaysNothing) {
  const OutputColour colour = read_output_colour(test::small_scene());
  EXPECT_THAT(colour.profile, IsEmpty());
  EXPECT_EQ(colour.display.config, "");
}

TEST(OutputColour, BadFilesAreNamedBeforeTheWork) {
  const test::Folder folder;
  folder.write("printer.icc", "no profile");
  folder.write("show.ocio", "no config: [");
  const auto refused = [&](const std::string& setting) {
    return test::input_error(
        [&] { read_output_colour(test::small_scene({setting}, folder.path())); });
  };
  EXPECT_THAT(refused("output.profile=printer.icc"), HasSubstr("printer.icc"));
  EXPECT_THAT(refused("output.ocio_config=show.ocio"), HasSubstr("show.ocio"));
}

TEST(OutputColour, TakesSpacesByNameAndPresses) {
  const OutputColour p3 = read_output_colour(test::small_scene({"output.colours=display-p3"}));
  EXPECT_EQ(p3.profile, colour_space_profile("display-p3"));
  const test::Folder folder;
  const std::vector<std::uint8_t> bytes = test::press_profile();
  folder.write("press.icc", std::string(bytes.begin(), bytes.end()));
  const OutputColour press =
      read_output_colour(test::small_scene({"output.profile=press.icc", "output.intent=relative",
                                            "output.black_point=false", "output.ink_limit=280"},
                                           folder.path()));
  EXPECT_EQ(press.profile, test::press_profile());
  EXPECT_EQ(press.device.intent, RenderingIntent::relative);
  EXPECT_FALSE(press.device.black_point);
  EXPECT_EQ(press.ink_limit_percent, 280.0);
  const auto both = [&] {
    read_output_colour(
        test::small_scene({"output.colours=adobe-rgb", "output.profile=press.icc"}, folder.path()));
  };
  EXPECT_THAT(test::usage_error(both), HasSubstr("output.profile"));
}

}  // namespace
}  // namespace belvedere
