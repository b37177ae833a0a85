#include "renderer/world/fold_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/files.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

using test::Notes;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const GeoTransform fold_frame{500000.0, 5200000.0, 50.0, 50.0};
const glm::dvec2 handle_position{503000.0, 5197000.0};

// Level ground of 6 km, a handle in its middle, and an eye 5 km above `below`, which looks straight
// down on 3 km.
struct Ground {
  explicit Ground(double move_m, glm::dvec2 below = handle_position)
      : deformation(moved(move_m), handle_position) {
    terrain.generalized_m = Grid<float>(121, 121, 500.F);
    terrain.dem = std::make_shared<const Dem>(make_dem({terrain.generalized_m, fold_frame, {}}));
    CameraParameters parameters;
    parameters.projection = "oblique";
    parameters.width = parameters.height = 100;
    parameters.pitch_deg = -90.0;
    parameters.view_width_m = 3000.0;
    parameters.eye = {below, 5000.0};
    camera = make_camera(parameters);
    scene.handles.emplace_back().name = "Hochkar";
  }
  static DeformParameters moved(double move_m) {
    DeformParameters parameters;
    parameters.handles = {
        {.centre = handle_position, .move_m = {move_m, 0.0}, .radius_m = 1200.0, .core_m = 400.0}};
    return parameters;
  }
  std::vector<std::string> check() const {
    Notes notes;
    check_folds(scene, terrain, deformation, *camera, notes);
    return notes.all;
  }

  SceneDeform scene;
  Deformation deformation;
  TerrainModel terrain;
  std::unique_ptr<const Camera> camera;
};

TEST(FoldCheck, GroundThatIsNotFoldedPasses) { EXPECT_THAT(Ground(100.0).check(), IsEmpty()); }

TEST(FoldCheck, FoldsInThePictureAreRefusedUnlessAllowed) {
  Ground ground(1100.0);
  const std::string message = test::message_of(ErrorKind::usage, [&] { ground.check(); });
  EXPECT_THAT(message, AllOf(HasSubstr("deform.handles.0 (Hochkar)"),
                             HasSubstr("in the picture around E 503"), HasSubstr("allow_folds")));
  ground.scene.handles[0].name.clear();
  EXPECT_THAT(test::message_of(ErrorKind::usage, [&] { ground.check(); }),
              HasSubstr("deform.handles.0: folds"));
  ground.scene.allow_folds = true;
  EXPECT_THAT(ground.check(), SizeIs(1));
}

TEST(FoldCheck, FoldsBesideThePictureAreNoted) {
  const Ground ground(1100.0, handle_position + glm::dvec2(0.0, 20000.0));
  const std::vector<std::string> notes = ground.check();
  ASSERT_THAT(notes, SizeIs(1));
  EXPECT_THAT(notes[0], AllOf(HasSubstr("Hochkar"), HasSubstr("folds the ground"),
                              Not(HasSubstr("in the picture"))));
}

}  // namespace
}  // namespace belvedere
