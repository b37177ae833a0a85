#include "renderer/register/registered_ground.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <utility>

#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "renderer/world/view.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

constexpr float sky = std::numeric_limits<float>::quiet_NaN();

TEST(RegisteredGround, IsTheGroundThatTheRegistrationShows) {
  // Ground that rises to the north.
  const Dem dem = make_dem({test::grid_of(200, 200, [](int, int y) { return 1500.0 - 5.0 * y; }),
                            {660000.0, 5280000.0, 250.0, 250.0},
                            normalize_crs("EPSG:32632")});
  std::vector<ControlPair> pairs = test::synthetic_places(40);
  for (ControlPair& pair : pairs)
    pair.altitude_m = 1500.0 - 5.0 * (dem.transform.to_cell(0.0, pair.position.y).y);
  const test::SyntheticView truth = test::synthetic_view(ViewKind::plane, pairs);
  test::paint(truth, pairs);
  std::erase_if(pairs, [](const ControlPair& p) {
    return p.pixel.x < 0.0 || p.pixel.x > 1200.0 || p.pixel.y < 0.0 || p.pixel.y > 550.0;
  });
  ASSERT_GE(pairs.size(), 12U);
  const Registration found = register_pairs(pairs, {1200, 550});
  const RegisteredView view(found, registered_scene(found, {1200, 550}), dem, {300, 138},
                            silent_progress());
  const RegisteredGround ground = trace_registered(view);
  EXPECT_EQ(folded_facets(view), 0U);
  int near = 0;
  for (const ControlPair& pair : pairs) {
    const int x = std::min(299, static_cast<int>(pair.pixel.x / 4.0));
    const int y = std::min(137, static_cast<int>(pair.pixel.y / 4.0));
    near += std::abs(ground.altitude_m(x, y) - pair.altitude_m) < 25.0 ? 1 : 0;
    EXPECT_LT(ground.sigma_px(x, y), 12.F);
  }
  EXPECT_GE(near, static_cast<int>(pairs.size()) - 1);
}

TEST(RegisteredGround, ContoursLieBetweenAltitudes) {
  RegisteredGround ground{
      test::grid_of(8, 4, [](int x, int y) { return y == 0 ? sky : 90.0 + 5.0 * x; }),
      Grid<float>(8, 4, 1000.F), Grid<float>(8, 4, 1.F)};
  for (int x = 0; x < 8; ++x) ground.distance_m(x, 0) = sky;
  const Grid<glm::vec3> grey(8, 4, glm::vec3(0.5F));
  const Grid<glm::vec3> drawn = contours_over(grey, ground, 100.0);
  // 100 m lies between x = 1 and 2; the skyline between the first two rows.
  EXPECT_LT(drawn(1, 2).x, 0.4F);
  EXPECT_EQ(drawn(3, 2), glm::vec3(0.5F));
  EXPECT_GT(drawn(3, 0).x, 0.9F);
  EXPECT_LT(drawn(3, 0).y, 0.2F);
}

TEST(RegisteredGround, ContoursAreTenOrMore) {
  EXPECT_EQ(contour_step_m(test::grid_of(100, 2, [](int x, int) { return 30.0 * x; })), 200.0);
  EXPECT_EQ(contour_step_m(test::grid_of(100, 2, [](int x, int) { return 2.0 * x; })), 20.0);
  EXPECT_EQ(contour_step_m(Grid<float>(3, 3, sky)), 20.0);
}

TEST(RegisteredGround, TrustFadesToTheLimit) {
  Grid<float> sigma(3, 1, 0.F);
  sigma(1, 0) = 12.F;
  sigma(2, 0) = sky;
  const Grid<glm::vec3> picture = trust_picture(sigma, 12.0);
  EXPECT_GT(picture(0, 0).y, 0.9F);
  EXPECT_LT(picture(1, 0).y, 0.2F);
  EXPECT_GT(picture(2, 0).z, 0.75F);
}

// A plane that falls to the south, and pairs of it in a painting.
std::pair<Dem, std::vector<ControlPair>> tilted_ground() {
  Dem dem = make_dem({test::grid_of(200, 200, [](int, int y) { return 1500.0 - 5.0 * y; }),
                      {660000.0, 5280000.0, 250.0, 250.0},
                      normalize_crs("EPSG:32632")});
  std::vector<ControlPair> pairs = test::synthetic_places(40);
  for (ControlPair& pair : pairs)
    pair.altitude_m = 1500.0 - 5.0 * dem.transform.to_cell(0.0, pair.position.y).y;
  test::paint(test::synthetic_view(ViewKind::plane, pairs), pairs);
  return {std::move(dem), std::move(pairs)};
}

// Ground of the DEM is seen where the painting has it, at half its size.
TEST(RegisteredView, ShowsPlacesWhereThePaintingDoes) {
  const auto [dem, pairs] = tilted_ground();
  const Registration found = register_pairs(pairs, {1200, 550});
  const RegisteredView view(found, registered_scene(found, {1200, 550}), dem, {600, 275},
                            silent_progress());
  EXPECT_EQ(view.size_px(), glm::ivec2(600, 275));
  int in_picture = 0;
  for (const ControlPair& pair : pairs) {
    const auto at = view.map().to_image(pair.position);
    ASSERT_TRUE(at);
    EXPECT_LT(glm::length(2.0 * at->pixel - pair.pixel), 1.0);
    if (!at->visible) continue;
    ++in_picture;
    const auto back = view.map().to_geo(at->pixel);
    ASSERT_TRUE(back);
    EXPECT_LT(glm::length(back->position - pair.position), 1.0);
  }
  EXPECT_GT(in_picture, 10);
}

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

// A mountain in the middle of the picture that was not moved, as far as is known.
TEST(RegisteredGround, IsLessSureOnAMountainWhoseMoveIsOpen) {
  const auto [dem, pairs] = tilted_ground();
  Registration found = register_pairs(pairs, {1200, 550});
  const auto trace = [&] {
    return trace_registered(RegisteredView(found, registered_scene(found, {1200, 550}), dem,
                                           {150, 69}, silent_progress()));
  };
  const ControlPair& middle =
      *std::min_element(pairs.begin(), pairs.end(), [](const ControlPair& a, const ControlPair& b) {
        const glm::dvec2 centre(600.0, 275.0);
        return glm::length(a.pixel - centre) < glm::length(b.pixel - centre);
      });
  const glm::dvec2 summit = middle.position;
  found.mountains = {{summit, found.frame.extent_m, {}}};
  const RegisteredGround known = trace();
  const std::size_t unknowns = view_unknown::count + MovedMountain::unknowns;
  found.view_covariance = Matrix(unknowns, unknowns);
  for (std::size_t k = view_unknown::count; k < unknowns; ++k) found.view_covariance(k, k) = 1.0;
  const RegisteredGround open = trace();
  const double radius_m = handle_of(found.mountains.front()).radius_m;
  int on_it = 0, beside = 0;
  for (std::size_t i = 0; i < known.sigma_px.size(); ++i) {
    if (std::isnan(known.altitude_m[i])) continue;
    const double distance_m = glm::length(known.position[i] - summit);
    if (distance_m < 0.3 * radius_m) {
      ++on_it;
      EXPECT_GT(open.sigma_px[i], known.sigma_px[i] + 1.F);
    } else if (distance_m > 2.0 * radius_m) {
      ++beside;
      EXPECT_EQ(open.sigma_px[i], known.sigma_px[i]);
    }
  }
  EXPECT_GT(on_it, 5);
  EXPECT_GT(beside, 200);
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
