#include "terrain/shape/courses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {
namespace {

constexpr int width = 240;
constexpr int height = 160;
constexpr double course_cell_m = 30.0;

// A valley that winds from west to east and falls; its bottom lies at bottom_row.
double bottom_row(double x) { return 80.0 + 14.0 * std::sin(x / 23.0); }

Dem winding_valley() {
  Raster<float> raster;
  raster.cells = Grid<float>(width, height);
  raster.transform = {600000.0, 5200000.0, course_cell_m, course_cell_m};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double off = (y - bottom_row(x)) * course_cell_m;
      raster.cells(x, y) = static_cast<float>(1500.0 - 0.01 * x * course_cell_m + 0.25 * std::abs(off) + 1e-5 * off * off);
    }
  return make_dem(std::move(raster));
}

struct Valley {
  Dem dem = winding_valley();
  Grid<float> km2 = flow_accumulation_km2(dem.altitude_m, course_cell_m);

  glm::dvec2 at(double x, double y) const { return dem.transform.to_crs(x, y); }
  // From the bottom, m, of places away from the ends.
  double farthest_m(const Course& course) const {
    double most = 0.0;
    for (const glm::dvec2 place : course.places) {
      const glm::dvec2 cell = dem.transform.to_cell(place.x, place.y);
      if (cell.x < 12.0 || cell.x > width - 12.0) continue;
      most = std::max(most, std::abs(cell.y - bottom_row(cell.x)) * course_cell_m);
    }
    return most;
  }
};

double sharpest_turn_deg(const Course& course) {
  double most = 0.0;
  for (std::size_t i = 1; i + 1 < course.places.size(); ++i) {
    const glm::dvec2 a = glm::normalize(course.places[i] - course.places[i - 1]);
    const glm::dvec2 b = glm::normalize(course.places[i + 1] - course.places[i]);
    most = std::max(most, std::acos(std::min(1.0, glm::dot(a, b))) * 180.0 / M_PI);
  }
  return most;
}

TEST(Courses, ARoughLineFindsTheBottomOfItsValley) {
  const Valley valley;
  // Straight through the bends, up to 420 m beside the bottom.
  const DrawnCourse drawn{.places = {valley.at(2, 80), valley.at(width - 3, 80)}, .snap_m = 600.0};
  const Courses laid = lay_courses({drawn}, valley.dem, valley.km2);
  ASSERT_EQ(laid.lines.size(), 1U);
  EXPECT_LT(valley.farthest_m(laid.lines[0]), 1.2 * course_cell_m);
  EXPECT_LT(sharpest_turn_deg(laid.lines[0]), 20.0) << "no stairs of the grid";
  EXPECT_LE(laid.most_moved_m, 600.0);
  EXPECT_GT(laid.most_moved_m, 300.0);
  // Down the valley, however it was drawn.
  EXPECT_LT(laid.lines[0].places.front().x, laid.lines[0].places.back().x);
  DrawnCourse back = drawn;
  std::swap(back.places[0], back.places[1]);
  const Courses turned = lay_courses({back}, valley.dem, valley.km2);
  EXPECT_LT(turned.lines[0].places.front().x, turned.lines[0].places.back().x);
}

TEST(Courses, NothingMovesFartherThanItMay) {
  const Valley valley;
  DrawnCourse drawn{.places = {valley.at(2, 80), valley.at(width - 3, 80)}, .snap_m = 90.0};
  EXPECT_LE(lay_courses({drawn}, valley.dem, valley.km2).most_moved_m, 90.0 + 1e-6);
  drawn.snap_m = 0.0;
  const Courses laid = lay_courses({drawn}, valley.dem, valley.km2);
  EXPECT_LT(laid.most_moved_m, 1e-6);
}

// Data of good maps stay where they are: the bottom lies where they have the river.
TEST(Courses, AGoodLineStays) {
  const Valley valley;
  DrawnCourse drawn{.places = {}, .snap_m = 150.0};
  for (int x = 2; x < width - 2; ++x) drawn.places.push_back(valley.at(x, bottom_row(x)));
  const Courses laid = lay_courses({drawn}, valley.dem, valley.km2);
  EXPECT_LT(laid.most_moved_m, course_cell_m);
  EXPECT_LT(laid.mean_moved_m, 0.4 * course_cell_m);
}

TEST(Courses, WidthsFollowTheCatchmentOrTheMap) {
  const Valley valley;
  DrawnCourse drawn{.places = {valley.at(2, 80), valley.at(width - 3, 80)}, .snap_m = 600.0};
  const Course by_catchment = lay_courses({drawn}, valley.dem, valley.km2).lines.at(0);
  for (std::size_t i = 0; i < by_catchment.places.size(); ++i) {
    const double there = known_half_width_m(valley.km2(width - 8, static_cast<int>(std::lround(bottom_row(width - 8)))));
    EXPECT_LE(by_catchment.half_width_m[i], there * 1.05);
  }
  EXPECT_GT(by_catchment.half_width_m.back(), by_catchment.half_width_m.front());
  drawn.width_m = 70.0;
  const Course by_map = lay_courses({drawn}, valley.dem, valley.km2).lines.at(0);
  for (const float half : by_map.half_width_m) EXPECT_NEAR(half, 35.F, 1e-4F);
  drawn.width_m = 0.0;
  drawn.least_width_m = 24.0;
  const Course seen = lay_courses({drawn}, valley.dem, valley.km2).lines.at(0);
  for (const float half : seen.half_width_m) EXPECT_GE(half, 11.99F);
  // The law is that of guessed rivers where these have their whole width.
  for (const double km2 : {110.0, 500.0, 1e5}) EXPECT_NEAR(known_half_width_m(km2), river_half_width_m(km2), 0.02);
  EXPECT_GT(known_half_width_m(1.0), 1.0);
}

TEST(Courses, PiecesOfOneRiverAreOneRiver) {
  const Valley valley;
  const std::vector<glm::dvec2> cuts = {valley.at(2, 80), valley.at(70, 80), valley.at(150, 80), valley.at(width - 3, 80)};
  const DrawnCourse whole{.places = cuts, .snap_m = 500.0};
  const Courses one = lay_courses({whole}, valley.dem, valley.km2);
  // In pieces, in any order, one of them turned.
  std::vector<DrawnCourse> pieces;
  for (std::size_t i : {2U, 0U, 1U}) pieces.push_back({.places = {cuts[i], cuts[i + 1]}, .snap_m = 500.0});
  std::swap(pieces[1].places[0], pieces[1].places[1]);
  const Courses joined = lay_courses(pieces, valley.dem, valley.km2);
  EXPECT_EQ(joined.joined, 2U);
  ASSERT_EQ(joined.lines.size(), 1U);
  ASSERT_NEAR(static_cast<double>(joined.lines[0].places.size()), static_cast<double>(one.lines[0].places.size()), 2.0);
  EXPECT_LT(valley.farthest_m(joined.lines[0]), 1.2 * course_cell_m);
  // Other groups stay apart.
  pieces[2].group = 1;
  EXPECT_GT(lay_courses(pieces, valley.dem, valley.km2).lines.size(), 1U);
  // A ring is no trap.
  const DrawnCourse a{.places = {valley.at(20, 20), valley.at(40, 20), valley.at(40, 40)}};
  const DrawnCourse b{.places = {valley.at(40, 40), valley.at(20, 40), valley.at(20, 20)}};
  EXPECT_EQ(lay_courses({a, b}, valley.dem, valley.km2).lines.size(), 1U);
}

TEST(Courses, ATributaryFlowsIntoTheRiver) {
  const Valley valley;
  const DrawnCourse river{.places = {valley.at(2, 80), valley.at(width - 3, 80)}, .snap_m = 600.0};
  // Ends on the map's line, beyond where the river comes to lie.
  const DrawnCourse brook{.places = {valley.at(110, 10), valley.at(112, 80)}, .snap_m = 600.0};
  const Courses laid = lay_courses({river, brook}, valley.dem, valley.km2);
  ASSERT_EQ(laid.lines.size(), 2U);
  double nearest = 1e9;
  for (const glm::dvec2 place : laid.lines[0].places) nearest = std::min(nearest, glm::distance(place, laid.lines[1].places.back()));
  EXPECT_LT(nearest, 1e-6);
  EXPECT_LT(laid.lines[1].half_width_m.back(), 0.7F * laid.lines[0].half_width_m[110]) << "before its mouth it does not feel the river";
}

TEST(Courses, WhatLiesBesideTheGroundIsSaid) {
  const Valley valley;
  const DrawnCourse away{.places = {{0.0, 0.0}, {1.0, 1.0}}};
  const DrawnCourse through{
      .places = {valley.at(-400, 80), valley.at(50, 80), valley.at(60, -300), valley.at(100, -300), valley.at(110, 80)}};
  const Courses laid = lay_courses({away, through}, valley.dem, valley.km2);
  EXPECT_EQ(laid.outside, 1U);
  EXPECT_EQ(laid.lines.size(), 2U) << "it leaves and comes back";
  EXPECT_TRUE(lay_courses({}, valley.dem, valley.km2).lines.empty());
}

TEST(Courses, TheSameForAnyThreads) {
  const Valley valley;
  std::vector<DrawnCourse> drawn;
  for (int i = 0; i < 40; ++i) drawn.push_back({.places = {valley.at(5 * i, 10), valley.at(5 * i + 7, 150)}, .snap_m = 200.0});
  const Courses many = lay_courses(drawn, valley.dem, valley.km2);
  const ThreadLimit one(1);
  const Courses few = lay_courses(drawn, valley.dem, valley.km2);
  ASSERT_EQ(many.lines.size(), few.lines.size());
  for (std::size_t i = 0; i < many.lines.size(); ++i) EXPECT_EQ(many.lines[i].places, few.lines[i].places);
}

}  // namespace
}  // namespace belvedere
