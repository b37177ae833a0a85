#include "renderer/register/registered_scene.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>

#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "renderer/world/view.h"
#include "terrain/io/raster_io.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

// Level ground around the places of synthetic_view.h.
Dem level_dem() {
  return make_dem({Grid<float>(200, 200, 500.F),
                   {660000.0, 5280000.0, 250.0, 250.0},
                   normalize_crs("EPSG:32632")});
}

// A registration without any fit: a view that is not as priors expect, and ground that is moved.
Registration synthetic_registration(ViewKind kind, double scale) {
  const std::vector<ControlPair> places = test::synthetic_places(40);
  const test::SyntheticView synthetic = test::synthetic_view(kind, places);
  Registration out;
  out.scale = scale;
  out.frame = synthetic.frame;
  out.view = synthetic.view;
  out.view[view_unknown::exaggeration + 1] = 0.25;
  out.view[view_unknown::exaggeration + 2] = -0.1;
  out.view[view_unknown::drop + 2] = 0.15;
  out.view[view_unknown::bend] = 0.1;
  out.view[view_unknown::bend + 1] = -0.2;
  out.displacement = {
      .length_m = 4000.0, .reach_m = 1500.0, .still_m = 20.0, .max_m = 1200.0, .places = {}};
  for (const ControlPair& place : places)
    out.displacement.places.push_back({place.position, {10.0, -5.0}, {30.0, 30.0}});
  out.displacement.places[7].moved = {500.0, 200.0};
  out.displacement.places[21].moved = {-300.0, 100.0};
  return out;
}

// The largest distance between where the registration and where its scene show places.
double worst_px(const Registration& found, glm::ivec2 painting_px) {
  Scene scene = registered_scene(found, painting_px);
  // As a file tells it.
  scene.terrain.sources.emplace_back().file = "dem.tif";
  const Scene read = parse_scene(write_scene(scene), "registered.toml", ".", {}).scene;
  const Dem dem = level_dem();
  const View view = make_view(read, dem, silent_progress());
  const Deformation deformation(view.deform, view.viewer_xy);
  const std::unique_ptr<Camera> camera = make_camera(view.camera);
  const DisplacementField field(found.displacement);
  double worst = 0.0;
  for (const ControlPair& place : test::synthetic_places(300, 4)) {
    const auto drawn = camera->project(deformation.point({place.position, place.altitude_m}));
    EXPECT_TRUE(drawn);
    if (!drawn) continue;
    worst = std::max(worst, glm::length(*drawn - registered_pixel(found, field, place.position,
                                                                  place.altitude_m)));
  }
  return worst;
}

TEST(RegisteredScene, ShowsPlacesWhereTheRegistrationDoes) {
  for (const ViewKind kind : {ViewKind::cylinder, ViewKind::panini, ViewKind::plane})
    EXPECT_LT(worst_px(synthetic_registration(kind, 1.0), {1200, 550}), 0.3)
        << view_kind_name(kind);
}

TEST(RegisteredScene, MountainsThatWereMovedAreHandles) {
  Registration found = synthetic_registration(ViewKind::plane, 1.0);
  found.mountains = {
      {{684000.0, 5255000.0}, found.frame.extent_m, {0.3, 0.0, 0.4, 0.8, -0.5, 1.4, 0.6}},
      {{676000.0, 5263000.0}, found.frame.extent_m, {0.0, 0.2, 0.0, -0.7, 0.0}}};
  const Scene scene = registered_scene(found, {1200, 550});
  ASSERT_EQ(scene.deform.handles.size(), 2U);
  EXPECT_NEAR(scene.deform.handles[0].handle.rotate_deg, 35.0, 1e-9);
  EXPECT_EQ(scene.generalize.valleys.width_m, 0.F);
  EXPECT_LT(worst_px(found, {1200, 550}), 0.3);
}

TEST(RegisteredScene, WidensTheValleysAsThePainterDid) {
  Registration found = synthetic_registration(ViewKind::plane, 1.0);
  found.valleys_m = 300.0;
  EXPECT_EQ(registered_scene(found, {1200, 550}).generalize.valleys.width_m, 300.F);
}

TEST(RegisteredScene, OfALargerPaintingAndOfACroppedOne) {
  for (const ViewKind kind : {ViewKind::cylinder, ViewKind::panini, ViewKind::plane}) {
    Registration found = synthetic_registration(kind, 2.5);
    found.frame.cropped = true;
    found.view[view_unknown::middle] = 0.11;
    found.view[view_unknown::middle + 1] = -0.04;
    EXPECT_LT(worst_px(found, {3000, 1375}), 0.75) << view_kind_name(kind);
  }
}

TEST(RegisteredScene, TheBendOnlyLowersTheGround) {
  const Scene scene =
      registered_scene(synthetic_registration(ViewKind::cylinder, 1.0), {1200, 550});
  const BendProfile bend(scene.deform.ground.bend);
  for (const BendPoint& point : scene.deform.ground.bend.points)
    EXPECT_GE(bend.drop_m(point.distance_m), -1e-6);
  EXPECT_NEAR(*scene.deform.ground.bend.points.back().inclination_deg, 0.0, 2.0);
}

}  // namespace
}  // namespace belvedere
