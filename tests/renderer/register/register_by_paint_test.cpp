#include "renderer/register/register_by_paint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/filter.h"
#include "base/random.h"
#include "base/statistics.h"
#include "renderer/register/registered_ground.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

// Hills over the places of synthetic_view.h.
double altitude_at(double east, double north) {
  const double x = east / 1000.0, y = north / 1000.0;
  return 1300.0 + 400.0 * std::sin(0.9 * x + 0.5 * y) + 350.0 * std::sin(0.7 * y - 0.8 * x) +
         150.0 * std::sin(1.9 * x);
}

Dem hilly_dem() {
  const GeoTransform transform{660000.0, 5280000.0, 400.0, 400.0};
  return make_dem({test::grid_of(125, 125,
                                 [&](int x, int y) {
                                   const glm::dvec2 at = transform.to_crs(x, y);
                                   return altitude_at(at.x, at.y);
                                 }),
                   transform, normalize_crs("EPSG:32632")});
}

// The ground that a registration shows, lit from the left, below a pale sky.
Grid<glm::vec3> painted(const Registration& truth, const Dem& dem, glm::ivec2 size) {
  const RegisteredGround ground = trace_registered(
      RegisteredView(truth, registered_scene(truth, {1200, 550}), dem, size, silent_progress()));
  const glm::vec3 sun = glm::normalize(glm::vec3(-1.F, 0.4F, 0.7F));
  Grid<glm::vec3> out(size.x, size.y, glm::vec3(0.8F, 0.88F, 0.95F));
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!std::isnan(ground.altitude_m[i]))
      out[i] = glm::vec3(0.35F, 0.45F, 0.25F) + 0.3F * glm::dot(ground.normal[i], sun);
  return out;
}

TEST(RegisterByPaint, ThePaintIsMoreExactThanClicks) {
  const Dem dem = hilly_dem();
  constexpr glm::ivec2 size(400, 183);
  std::vector<ControlPair> pairs = test::synthetic_places(40);
  for (ControlPair& pair : pairs) pair.altitude_m = altitude_at(pair.position.x, pair.position.y);
  const test::SyntheticView view = test::synthetic_view(ViewKind::plane, pairs);
  test::paint(view, pairs);
  std::erase_if(pairs, [](const ControlPair& p) {
    return p.pixel.x < 0.0 || p.pixel.x > 1200.0 || p.pixel.y < 0.0 || p.pixel.y > 550.0;
  });
  ASSERT_GE(pairs.size(), 15U);
  Registration truth;
  truth.frame = view.frame;
  truth.view = view.view;
  // Still ground: the scene's curves reach from the nearest place to the farthest.
  for (const ControlPair& pair : pairs)
    truth.displacement.places.push_back({pair.position, {}, {30.0, 30.0}});
  const Grid<glm::vec3> painting = painted(truth, dem, size);
  std::vector<ControlPair> clicks = pairs;
  for (std::size_t i = 0; i < clicks.size(); ++i) {
    const auto n = static_cast<std::int64_t>(i);
    clicks[i].pixel.x = pairs[i].pixel.x / 3.0 + 2.0 * random_normal(9, n, 0);
    clicks[i].pixel.y = pairs[i].pixel.y / 3.0 + 2.0 * random_normal(9, n, 1);
  }
  const Registration clicked =
      register_pairs(clicks, size, {.view = {.kinds = {ViewKind::plane}}, .sigma_px = 2.0});
  const auto distance_px = [&](const Registration& found) {
    const DisplacementField field(found.displacement);
    std::vector<double> off;
    for (const ControlPair& place : pairs)
      off.push_back(glm::length(registered_pixel(found, field, place.position, place.altitude_m) -
                                place.pixel / 3.0));
    return median(off);
  };
  const PaintRegistration found =
      register_by_paint(clicked, clicks, painting, dem, silent_progress());
  EXPECT_EQ(found.rounds, 1);  // the others need a wider painting
  EXPECT_GT(found.matches, 20U);
  EXPECT_LT(distance_px(found.registration), 0.7 * distance_px(clicked));
}

constexpr double cell_side_m = 60.0;

// A valley 12 km wide along column 100 that falls to the south.
Dem valley_dem() {
  return make_dem({test::grid_of(201, 300,
                                 [](int x, int y) {
                                   return 1500.0 - 1.2 * y + 0.4 * cell_side_m * std::abs(x - 100);
                                 }),
                   {680000.0, 5260000.0, cell_side_m, cell_side_m},
                   normalize_crs("EPSG:32632")});
}

ControlPair place_at(const Dem& dem, double column, double row) {
  ControlPair place{.position = dem.transform.to_crs(column, row)};
  place.altitude_m = static_cast<double>(sample_bilinear(dem.altitude_m, column, row));
  return place;
}

TEST(DrawnGround, WallsMoveApartWithWhatLiesOnThem) {
  const Dem dem = valley_dem();
  const DrawnGround wide = draw_ground(dem, 300.0, silent_progress());
  for (const double side : {-1.0, 1.0}) {
    const ControlPair wall = place_at(dem, 100.0 + 12.0 * side, 220.0);
    const ControlPair drawn = wide.drawn(wall);
    EXPECT_GT(side * (drawn.position.x - wall.position.x), 75.0);
    EXPECT_LT(side * (drawn.position.x - wall.position.x), 150.0);
    EXPECT_NEAR(drawn.altitude_m, wall.altitude_m, 25.0);
  }
  const ControlPair ridge = place_at(dem, 4.0, 150.0);
  EXPECT_LT(glm::length(wide.drawn(ridge).position - ridge.position), 5.0);
}

TEST(DrawnGround, WithoutWidthItIsTheMap) {
  const Dem dem = valley_dem();
  const DrawnGround plain = draw_ground(dem, 0.0, silent_progress());
  const ControlPair wall = place_at(dem, 112.0, 220.0);
  EXPECT_EQ(plain.drawn(wall).position, wall.position);
  EXPECT_EQ(plain.drawn(wall).altitude_m, wall.altitude_m);
  EXPECT_TRUE(
      std::equal(plain.dem.altitude_m.begin(), plain.dem.altitude_m.end(), dem.altitude_m.begin()));
}

}  // namespace
}  // namespace belvedere
