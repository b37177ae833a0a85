#include "renderer/pipeline/scene_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/pipeline/pipeline.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/renderer/pipeline/painted_scene.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

TEST(SceneCheck, SaysWhatIsKnownBeforeTheWork) {
  const SceneReport report =
      check_scene(test::small_scene({"synthesis.enabled=false"}), silent_progress());
  EXPECT_EQ(report.crs, "none");
  EXPECT_EQ(report.cells_wide, 120);
  EXPECT_EQ(report.cells_high, 120);
  EXPECT_EQ(report.cell_m, 100.0);
  EXPECT_EQ(report.view.camera.eye, glm::dvec3(6000.0, -4000.0, 6000.0));
  EXPECT_THAT(report.inputs, IsEmpty());
  EXPECT_THAT(report.exemplars, IsEmpty());
  double shares = 0.0;
  for (const auto& [id, share] : report.classes) {
    EXPECT_GT(share, 0.0) << class_name(id);
    shares += share;
  }
  EXPECT_NEAR(shares, 1.0, 1e-9);
  EXPECT_EQ(report.classes.front().first, LandCoverClass::sky) << "in the order of the classes";
}

TEST(SceneCheck, SaysWhatThePictureTakesOfTerrainLargerThanMemory) {
  test::Folder folder;
  Raster<float> raster{
      Grid<float>(600, 600), {600000.0, 5200000.0, 30.0, 30.0}, normalize_crs("EPSG:32632")};
  for (int y = 0; y < 600; ++y)
    for (int x = 0; x < 600; ++x) raster.cells(x, y) = 900.F + static_cast<float>(x + y);
  write_raster(folder / "terrain.tif", raster);
  const auto check = [&](const char* max) {
    return check_scene(
        parse_scene("version = 1\n[[terrain.sources]]\nfile = \"terrain.tif\"\n[camera]\nposition "
                    "= [609000, 5181000]\n"
                    "height_m = 4000\npitch_deg = -14\n[synthesis]\nenabled = "
                    "false\n[output]\nwidth = 100\nheight = 80\n",
                    "big.toml", folder / "", {.data_folders = {folder / ""}, .settings = {max}}),
        silent_progress());
  };
  const SceneReport report = check("terrain.max_mcells=0.25");
  EXPECT_THAT(report.larger_than_memory,
              HasSubstr("600 × 600 cells is more than memory holds: read at"));
  EXPECT_GT(report.cell_m, 30.0) << "looked at";
  EXPECT_LT(report.cells_wide, 600);
  EXPECT_EQ(check("terrain.max_mcells=1").larger_than_memory, "");
}

class PaintedSceneCheck : public testing::Test {
 protected:
  // Both refuse the scene in the same words, and nothing is written.
  std::string refused(ErrorKind kind, const LoadedScene& scene) const {
    const std::string check =
        test::message_of(kind, [&] { check_scene(scene, silent_progress()); });
    const std::string render_message =
        test::message_of(kind, [&] { render(scene, folder_ / "out", {}); });
    EXPECT_EQ(check, render_message);
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    return check;
  }
  test::Folder folder_;
};

TEST_F(PaintedSceneCheck, RefusesWhatRenderingRefuses) {
  test::write_painting(folder_);
  fs::resize_file(folder_ / "red.png", fs::file_size(folder_ / "red.png") / 2);
  EXPECT_THAT(refused(ErrorKind::input, test::painted_scene(folder_)), HasSubstr("red.png"));
  EXPECT_THAT(refused(ErrorKind::input, test::painted_scene(folder_, {"synthesis.colours=painting",
                                                                      "synthesis.enabled=false"})),
              HasSubstr("red.png"));
  fs::remove(folder_ / "red.png");
  EXPECT_THAT(refused(ErrorKind::input, test::painted_scene(folder_)),
              HasSubstr("exemplar.0.picture"));
  folder_.write("printer.icc", "no profile");
  EXPECT_THAT(
      refused(ErrorKind::input, test::small_scene({"output.profile=printer.icc"}, folder_.path())),
      HasSubstr("printer.icc"));
}

TEST_F(PaintedSceneCheck, AClassOfThePictureNeedsTexelsOrAFallback) {
  test::write_painting(folder_);
  const SceneReport whole = check_scene(test::painted_scene(folder_), silent_progress());
  EXPECT_THAT(whole.exemplars, SizeIs(1));
  ASSERT_THAT(whole.exemplar_classes, SizeIs(1));
  for (const auto& [id, share] : whole.classes) {  // the painting has all classes of the ground
    if (id == LandCoverClass::sky) continue;
    EXPECT_THAT(whole.exemplar_classes[0], testing::Contains(id));
  }
  EXPECT_THAT(whole.inputs, SizeIs(2));
  // Water (1) and fields only: other classes of the hills must not be painted.
  test::write_painting(folder_, 2);
  const std::string message = test::message_of(
      ErrorKind::usage, [&] { check_scene(test::painted_scene(folder_), silent_progress()); });
  EXPECT_THAT(message, AllOf(HasSubstr("small"), HasSubstr("forest"), HasSubstr("fallback"),
                             Not(HasSubstr("sky"))));
}

TEST_F(PaintedSceneCheck, AViewStandsForThePixelsOfItsPicture) {
  test::write_painting(folder_);
  const SceneExemplars looked = look_at_exemplars(
      test::painted_scene(folder_, {"output.width=960", "output.height=800"}), silent_progress());
  EXPECT_EQ(looked.view.width(), 480);
  EXPECT_EQ(looked.view.height(), 400);
  EXPECT_EQ(looked.pixels_of_picture, 4.0);
  EXPECT_THAT(looked.exemplars, SizeIs(1));
}

}  // namespace
}  // namespace belvedere
