#include "renderer/pipeline/scene_paint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/files.h"
#include "tests/renderer/pipeline/painted_scene.h"

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
    return test::message_of(ErrorKind::input, [&] { require_inputs(loaded); });
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

}  // namespace
}  // namespace belvedere
