#include "renderer/world/view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string>

#include "base/math.h"
#include "renderer/scene/scene_file.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/notes.h"

// Camera and sun of a scene on its terrain. How the keys of [deform] become a deformation is tested
// in tests/renderer/scene/scene_deform_test.cpp.

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Level ground at 1000 m, 20 km square around E 500000 + `east_m` N 5200000: on the central
// meridian of UTM zone 32 where that is 0.
Dem level(const std::string& crs = "EPSG:32632", double east_m = 0.0) {
  Raster<float> raster{Grid<float>(201, 201, 1000.F),
                       {490000.0 + east_m, 5210000.0, 100.0, 100.0},
                       crs.empty() ? std::string() : normalize_crs(crs)};
  return make_dem(std::move(raster));
}

Scene scene_of(const std::string& text) {
  return parse_scene("version = 1\n" + text, "s.toml", ".", {}).scene;
}

View view_of(const std::string& text, const Dem& dem = level()) {
  return make_view(scene_of(text), dem, silent_progress());
}

std::string refused(const std::string& text, const Dem& dem = level()) {
  return test::usage_error([&] { view_of(text, dem); });
}

const std::string centre = "[camera]\nposition = [500000, 5200000]\n";

TEST(View, HeightsCountFromTheDatumOrFromTheGround) {
  EXPECT_EQ(view_of(centre + "height_m = 2500\n").camera.eye,
            glm::dvec3(500000.0, 5200000.0, 2500.0));
  EXPECT_NEAR(view_of(centre + "height_m = 300\nheight_above_ground = true\n").camera.eye.z, 1300.0,
              1e-3);
  // The ground as drawn: twice as high above 400 m.
  EXPECT_NEAR(view_of(centre + "height_m = 300\nheight_above_ground = true\n[deform]\nexaggeration "
                               "= 2\nexaggeration_base_m = 400\n")
                  .camera.eye.z,
              1900.0, 1e-3);
}

TEST(View, AnEyeBelowTheGroundIsRefusedWithTheGroundsHeight) {
  EXPECT_THAT(refused(centre + "height_m = 900\n"),
              AllOf(HasSubstr("camera.height_m"), HasSubstr("900 m"), HasSubstr("1000 m")));
  EXPECT_THAT(refused(centre + "height_m = 1500\n[deform]\nexaggeration = 2\n"),
              HasSubstr("2000 m"));
  EXPECT_NO_THROW(view_of(centre + "height_m = 1001\n"));
}

TEST(View, BesideTheTerrainOnlyHeightsAboveTheDatumAreKnown) {
  const std::string outside = "[camera]\nposition = [400000, 5200000]\nheight_m = 10\n";
  EXPECT_EQ(view_of(outside).camera.eye.z, 10.0);
  EXPECT_THAT(refused(outside + "height_above_ground = true\n"),
              HasSubstr("camera.height_above_ground"));
  EXPECT_THAT(refused("[camera]\nheight_m = 2000\n"), HasSubstr("camera.position"));
}

TEST(View, DegreesBecomeMetresWhereTheTerrainHasACoordinateSystem) {
  const glm::dvec2 lonlat = transform_point("EPSG:32632", "EPSG:4326", {503000.0, 5201000.0});
  const std::string text = "[camera]\nposition_lonlat = [" + std::to_string(lonlat.x) + ", " +
                           std::to_string(lonlat.y) + "]\nheight_m = 2000\n";
  EXPECT_LT(glm::length(view_of(text).viewer_xy - glm::dvec2(503000.0, 5201000.0)), 0.2);
  EXPECT_THAT(refused(text, level("")), HasSubstr("camera.position_lonlat"));
}

TEST(View, LooksAtAPointOfTheGroundOrOfTheAir) {
  const std::string above = centre + "height_m = 2000\n";
  const View down = view_of(
      above + "look_at = [501000, 5200000]\ntilt_deg = 0\n");  // 1 km to the east, 1 km lower
  EXPECT_NEAR(down.camera.azimuth_deg, 90.0, 1e-9);
  EXPECT_NEAR(down.camera.pitch_deg, -45.0, 1e-6);
  const View level_view = view_of(above +
                                  "look_at = [499000, 5199000]\nlook_at_altitude_m = "
                                  "2000\ntilt_deg = 0\n[deform]\nexaggeration = 1\n");
  EXPECT_NEAR(std::remainder(level_view.camera.azimuth_deg - 225.0, 360.0), 0.0, 1e-9);
  EXPECT_NEAR(level_view.camera.pitch_deg, 0.0, 1e-9);
  EXPECT_NEAR(view_of(above + "look_at = [501000, 5200000]\ntilt_deg = 7\n").camera.pitch_deg,
              -38.0, 1e-6);
  EXPECT_THAT(refused(above + "look_at = [500000, 5200000]\n"), HasSubstr("camera.look_at"));
  // Without a tilt it is raised to the sky's share, as far as the point stays in the picture: 38 %
  // of its height, 2 atan(tan 25° 11 / 24).
  EXPECT_NEAR(view_of(above + "look_at = [501000, 5200000]\n").camera.pitch_deg,
              -45.0 + 0.38 * 24.13, 0.02);
}

TEST(View, PictureAndProjectionAreTheScenes) {
  const View view = view_of(centre +
                            "height_m = 3000\nazimuth_deg = 120\npitch_deg = -30\nprojection = "
                            "\"oblique\"\nview_width_m = 7000\n" +
                            "[output]\nwidth = 640\nheight = 300\n");
  EXPECT_EQ(view.camera.projection, "oblique");
  EXPECT_EQ(view.camera.width, 640);
  EXPECT_EQ(view.camera.height, 300);
  EXPECT_EQ(view.camera.view_width_m, 7000.0);
  EXPECT_EQ(view.camera.azimuth_deg, 120.0);
  EXPECT_EQ(view.camera.pitch_deg, -30.0);
  EXPECT_THAT(refused(centre + "height_m = 3000\npitch_deg = 5\nprojection = \"oblique\"\n"),
              HasSubstr("camera.pitch_deg"));
}

TEST(View, TheSunsSideInThePicture) {
  const auto side = [](int camera, int sun) {
    return view_of(centre + "height_m = 3000\nazimuth_deg = " + std::to_string(camera) +
                   "\n[sun]\nazimuth_deg = " + std::to_string(sun) + "\naltitude_deg = 30\n")
        .sun_image_x;
  };
  EXPECT_NEAR(side(0, 90), 1.0, 1e-12);
  EXPECT_NEAR(side(0, 270), -1.0, 1e-12);
  EXPECT_NEAR(side(200, 230), 0.5, 1e-12);
  const glm::dvec3 sun =
      view_of(centre + "height_m = 3000\n[sun]\nazimuth_deg = 90\naltitude_deg = 30\n")
          .sun_direction;
  EXPECT_LT(glm::length(sun - glm::dvec3(std::cos(to_radians(30.0)), 0.0, 0.5)), 1e-9);
}

TEST(View, ASunBelowTheHorizonIsNoted) {
  test::Notes notes;
  make_view(scene_of(centre + "height_m = 3000\n[sun]\naltitude_deg = 1\n"), level(), notes);
  EXPECT_EQ(notes.text(), "");
  make_view(scene_of(centre + "height_m = 3000\n[sun]\naltitude_deg = -4\n"), level(), notes);
  EXPECT_THAT(notes.text(), HasSubstr("4.0° below the horizon"));
}

// Azimuths count from the grid's north. East of the central meridian true north is to the left of
// it, by the convergence of meridians: difference of longitude · sin(latitude), within a hundredth
// of a degree.
TEST(View, ATimeGivesTheSunAsTheGridSeesIt) {
  const std::string time = "2024-06-21T12:00:00Z";
  const std::string sun = "height_m = 3000\n[sun]\ntime = \"" + time + "\"\n";
  for (const double east_m : {0.0, 150000.0}) {
    const Dem dem = level("EPSG:32632", east_m);
    const glm::dvec2 lonlat =
        transform_point("EPSG:32632", "EPSG:4326", {500000.0 + east_m, 5200000.0});
    const SunPosition sky = sun_position(lonlat.x, lonlat.y, time);
    const View view = view_of(
        "[camera]\nposition = [" + std::to_string(500000.0 + east_m) + ", 5200000]\n" + sun, dem);
    const double convergence_deg = (lonlat.x - 9.0) * std::sin(to_radians(lonlat.y));
    EXPECT_NEAR(view.sun.azimuth_deg, sky.azimuth_deg - convergence_deg, 0.01) << east_m;
    EXPECT_NEAR(view.sun.altitude_deg, sky.altitude_deg, 1e-3) << "at the middle of the terrain";
  }
  EXPECT_THAT(refused(centre + sun, level("")), HasSubstr("sun.time"));
}

Dem ground(const std::string& crs) {
  return make_dem({Grid<float>(10, 10, 0.F),
                   {500000.0, 5200000.0, 100.0, 100.0},
                   crs.empty() ? std::string() : normalize_crs(crs)});
}

TEST(ScenePlace, DegreesAreLongitudeFirst) {
  // UTM zone 32: its central meridian is 9° east.
  const glm::dvec2 position =
      position_of_lonlat(ground("EPSG:32632"), {9.0, 47.0}, "camera.position_lonlat");
  EXPECT_NEAR(position.x, 500000.0, 1e-3);
  EXPECT_NEAR(position.y, 5205000.0, 1000.0);
}

TEST(ScenePlace, MetresAreTakenAsTheyAreAndDegreesConverted) {
  const Dem dem = ground("EPSG:32632");
  EXPECT_EQ(resolve_place(dem, glm::dvec2(1.0, 2.0), std::nullopt, "deform.handles.0"),
            glm::dvec2(1.0, 2.0));
  EXPECT_EQ(resolve_place(ground(""), glm::dvec2(1.0, 2.0), std::nullopt, "deform.handles.0"),
            glm::dvec2(1.0, 2.0));
  EXPECT_EQ(resolve_place(dem, std::nullopt, glm::dvec2(9.0, 47.0), "deform.handles.0"),
            position_of_lonlat(dem, {9.0, 47.0}, ""));
}

TEST(ScenePlace, RefusesNeitherAndDegreesWithoutACoordinateSystem) {
  EXPECT_THAT(test::usage_error([] {
                resolve_place(ground(""), std::nullopt, std::nullopt, "deform.handles.0");
              }),
              HasSubstr("deform.handles.0: no position"));
  EXPECT_THAT(test::usage_error([] {
                resolve_place(ground(""), std::nullopt, glm::dvec2(9.0, 47.0), "deform.handles.0");
              }),
              HasSubstr("deform.handles.0.position_lonlat"));
}

}  // namespace
}  // namespace belvedere
