#include "renderer/world/viewer_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

using test::Notes;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Level ground at 1000 m, 12 × 12 km in Tyrol: 11.38° E … 11.54° E, 47.40° N … 47.50° N.
Dem level_tyrol() {
  return make_dem({Grid<float>(120, 120, 1000.F),
                   {679000.0, 5264000.0, 100.0, 100.0},
                   normalize_crs("EPSG:32632")});
}

std::string refusal(const GivenPosition& given, double max_m = 50000.0) {
  return test::usage_error([&] { place_near_data(given, extent_of(level_tyrol()), max_m); });
}

TEST(ViewerCheck, DistancesCountFromTheSidesOfTheData) {
  const DataExtent data = extent_of(level_tyrol());
  EXPECT_EQ(data.box.low, glm::dvec2(679000.0, 5252000.0));
  EXPECT_NEAR(data.diagonal_m(), 16970.6, 0.1);
  EXPECT_EQ(data.distance_outside_m({680000.0, 5253000.0}), 0.0);
  EXPECT_NEAR(data.distance_outside_m({676000.0, 5248000.0}), 5000.0, 1e-6);
}

TEST(ViewerCheck, MistakenNumbersAreNamedWithTheReadingThatFits) {
  EXPECT_THAT(
      refusal({"camera.position", {11.45, 47.45}, false}),
      AllOf(HasSubstr("camera.position: E 11.45 N 47.45"), HasSubstr("km outside the data"),
            HasSubstr("E 679000…691000, N 5252000…5264000 of EPSG:32632"),
            HasSubstr("are these degrees?"), HasSubstr("camera.position_lonlat = [11.45, 47.45]")));
  EXPECT_THAT(refusal({"camera.position_lonlat", {47.45, 11.45}, true}),
              AllOf(HasSubstr("swapped?"), HasSubstr("camera.position_lonlat = [11.45, 47.45]")));
  EXPECT_THAT(refusal({"camera.position", {5258000.0, 685000.0}, false}),
              AllOf(HasSubstr("swapped?"), HasSubstr("camera.position = [685000, 5258000]")));
  EXPECT_THAT(refusal({"camera.position", {47.45, 11.45}, false}),
              HasSubstr("latitude before longitude"));
  EXPECT_THAT(
      refusal({"camera.position_lonlat", {685000.0, 5258000.0}, true}),
      AllOf(HasSubstr("outside the valid area"), HasSubstr("camera.position = [685000, 5258000]")));
  // An option takes degrees alone.
  EXPECT_THAT(refusal({"--from", {47.45, 11.45}, true}),
              AllOf(HasSubstr("--from"), HasSubstr("swapped?"), Not(HasSubstr("["))));
  // Where none fits, nothing is proposed.
  EXPECT_THAT(refusal({"camera.position", {1e6, 1e6}, false}), Not(HasSubstr("?")));
}

TEST(ViewerCheck, AViewerMayStandOutsideButNotFarAway) {
  const Dem dem = level_tyrol();
  SceneCamera camera;
  camera.position = {685000.0, 5180000.0};  // four diagonals
  EXPECT_EQ(place_viewer(camera, dem), *camera.position);
  camera.position = {685000.0, 5160000.0};  // five and a half
  EXPECT_THAT(test::usage_error([&] { place_viewer(camera, dem); }),
              HasSubstr("92.0 km outside the data"));
  // A point far away is a direction, unless its numbers are mistaken.
  camera.look_at = {685000.0, 6000000.0};
  EXPECT_EQ(place_target(camera, dem), *camera.look_at);
  camera.look_at = {11.45, 47.45};
  EXPECT_THAT(test::usage_error([&] { place_target(camera, dem); }),
              AllOf(HasSubstr("camera.look_at"), HasSubstr("degrees?")));
  camera.look_at.reset();
  EXPECT_EQ(place_target(camera, dem), std::nullopt);
}

// Notes of a picture of the ground, 2000 m above it.
std::vector<std::string> notes_of(glm::dvec2 viewer, double azimuth_deg, double pitch_deg) {
  const Dem dem = level_tyrol();
  const Deformation plain(DeformParameters{}, viewer);
  const DeformedSurface surface =
      deform(dem.altitude_m, dem.transform, glm::dvec3(viewer, 0.0), plain);
  const Tracer tracer(surface);
  const CameraParameters parameters{.width = 200,
                                    .height = 100,
                                    .eye = {viewer, 3000.0},
                                    .azimuth_deg = azimuth_deg,
                                    .pitch_deg = pitch_deg};
  Notes notes;
  check_ground_in_view(dem, *make_camera(parameters), tracer, notes);
  return notes.all;
}

TEST(ViewerCheck, APictureWithoutGroundIsRefused) {
  const glm::dvec2 inside{685000.0, 5258000.0}, south{685000.0, 5240000.0};
  EXPECT_THAT(notes_of(inside, 0.0, -20.0), IsEmpty());
  EXPECT_THAT(notes_of(south, 0.0, -10.0), IsEmpty()) << "0.7 diagonals outside";
  EXPECT_THAT(notes_of({685000.0, 5230000.0}, 0.0, -5.0),
              ElementsAre(HasSubstr("22.0 km outside the data")));
  const auto refused = [](glm::dvec2 viewer, double azimuth_deg, double pitch_deg) {
    return test::usage_error([&] { notes_of(viewer, azimuth_deg, pitch_deg); });
  };
  EXPECT_THAT(refused(south, 180.0, -10.0),
              AllOf(HasSubstr("camera: no ground is in the picture"),
                    HasSubstr("E 685000 N 5240000, 3000 m, is 12.0 km outside the data"),
                    HasSubstr("E 679000…691000")));
  EXPECT_THAT(refused(inside, 0.0, 60.0), HasSubstr("is in the data"));
}

// The far edge of the ground is atan(2/24) = 4.76° below the horizon. The last row of 48
// looks 12.86° below the centre, that of 100 looks 13.00°.
TEST(ViewerCheck, ASliverOfGroundIsGround) {
  const glm::dvec2 south{685000.0, 5240000.0};
  EXPECT_THAT(notes_of(south, 0.0, 13.00 - 4.76 - 0.07), IsEmpty());
  EXPECT_THROW(notes_of(south, 0.0, 13.00 - 4.76 + 0.07), Error);
}

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
  const std::string message = test::usage_error([&] { ground.check(); });
  EXPECT_THAT(message, AllOf(HasSubstr("deform.handles.0 (Hochkar)"),
                             HasSubstr("in the picture around E 503"), HasSubstr("allow_folds")));
  ground.scene.handles[0].name.clear();
  EXPECT_THAT(test::usage_error([&] { ground.check(); }), HasSubstr("deform.handles.0: folds"));
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
