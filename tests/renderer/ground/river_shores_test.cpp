#include "renderer/ground/river_shores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace belvedere {
namespace {

constexpr float river_half_m = 25.0F;

CoverRiver course(const std::function<glm::dvec2(double)>& way, double length_m) {
  CoverRiver river;
  river.rank = 7.0;
  for (double s = 0.0; s <= length_m; s += 45.0) {
    river.positions.push_back(way(s));
    river.half_width_m.push_back(river_half_m);
  }
  return river;
}
CoverRiver straight_course() {
  return course([](double s) { return glm::dvec2(s, 0.0); }, 90000.0);
}

std::vector<CoverRiver> shores_of(
    const CoverRiver& river, double units_per_m,
    const std::function<bool(glm::dvec2)>& is_open = [](glm::dvec2) { return true; },
    const std::function<bool(glm::dvec2)>& grows_trees = [](glm::dvec2) { return true; }) {
  const std::vector<CoverRiver> rivers = {river};
  return river_shores(
      rivers,
      {.units_per_m =
           [&](std::size_t) { return std::vector<double>(river.positions.size(), units_per_m); },
       .is_open = is_open,
       .grows_trees = grows_trees});
}

// Mean half width of strips of a class among positions chosen, over all positions of the river.
double mean_half_m(
    const std::vector<CoverRiver>& shores, LandCoverClass id, std::size_t count,
    const std::function<bool(glm::dvec2)>& chosen = [](glm::dvec2) { return true; }) {
  double sum = 0.0;
  for (const CoverRiver& strip : shores)
    for (std::size_t i = 0; i < strip.positions.size(); ++i)
      if (strip.painted_as == id && chosen(strip.positions[i]))
        sum += static_cast<double>(strip.half_width_m[i]);
  return sum / static_cast<double>(count);
}

TEST(RiverShores, HaveGapsAndLeaveTheWaterFree) {
  const CoverRiver river = straight_course();
  const std::vector<CoverRiver> shores = shores_of(river, 0.2);
  ASSERT_GT(shores.size(), 40U);
  for (const CoverRiver& strip : shores) {
    EXPECT_EQ(strip.kind, shore_kind);
    EXPECT_EQ(strip.rank, 7.0);
    ASSERT_EQ(strip.positions.size(), strip.half_width_m.size());
    for (std::size_t i = 0; i < strip.positions.size(); ++i) {
      const double off = std::abs(strip.positions[i].y);
      const double half = static_cast<double>(strip.half_width_m[i]);
      if (half == 0.0) continue;
      // Gravel begins at the bank; trees stand beyond it.
      if (strip.painted_as == LandCoverClass::sand) {
        EXPECT_NEAR(off, 25.0, 1e-6);
      } else {
        EXPECT_GE(off - half, 25.0 - 1e-3);
      }
    }
  }
  // No more than a third of the banks has trees.
  std::size_t grown = 0;
  for (const CoverRiver& strip : shores)
    if (strip.painted_as == LandCoverClass::forest)
      grown += static_cast<std::size_t>(std::count_if(strip.half_width_m.begin(),
                                                      strip.half_width_m.end(),
                                                      [](float half) { return half > 2.F; }));
  const double share =
      static_cast<double>(grown) / (2.0 * static_cast<double>(river.positions.size()));
  EXPECT_GT(share, 0.12);
  EXPECT_LT(share, 0.40);
}

// On a circle that turns left the inner bank is the left one.
TEST(RiverShores, GravelLiesInsideOfBendsAndTreesOutside) {
  constexpr double radius_m = 200.0;
  const auto circle = [&](double s) {
    return radius_m * glm::dvec2(std::cos(s / radius_m), std::sin(s / radius_m));
  };
  double gravel_in = 0.0;
  double gravel_out = 0.0;
  double trees_in = 0.0;
  double trees_out = 0.0;
  for (int k = 0; k < 40; ++k) {
    const glm::dvec2 middle(5000.0 * k, 0.0);
    const CoverRiver river = course([&](double s) { return middle + circle(s); }, 1100.0);
    const std::vector<CoverRiver> shores = shores_of(river, 0.2);
    const auto inside = [&](glm::dvec2 at) { return std::hypot(at.x - middle.x, at.y) < radius_m; };
    const auto outside = [&](glm::dvec2 at) { return !inside(at); };
    const std::size_t n = river.positions.size();
    gravel_in += mean_half_m(shores, LandCoverClass::sand, n, inside) / 40.0;
    gravel_out += mean_half_m(shores, LandCoverClass::sand, n, outside) / 40.0;
    trees_in += mean_half_m(shores, LandCoverClass::forest, n, inside) / 40.0;
    trees_out += mean_half_m(shores, LandCoverClass::forest, n, outside) / 40.0;
  }
  EXPECT_GT(gravel_in, 2.5 * gravel_out);
  EXPECT_GT(trees_out, 2.0 * trees_in);
}

TEST(RiverShores, NarrowAndUnseenRiversHaveNone) {
  EXPECT_TRUE(shores_of(straight_course(), 0.02).empty());
  EXPECT_TRUE(shores_of(straight_course(), 0.0).empty());
}

TEST(RiverShores, OnlyOpenGroundHasThem) {
  const std::vector<CoverRiver> shores =
      shores_of(straight_course(), 0.2, [](glm::dvec2 at) { return at.y > 0.0; });
  ASSERT_FALSE(shores.empty());
  for (const CoverRiver& strip : shores)
    for (std::size_t i = 0; i < strip.positions.size(); ++i)
      EXPECT_TRUE(strip.positions[i].y > 0.0 || strip.half_width_m[i] == 0.F);
}

// Above the treeline gravel alone lies on the banks.
TEST(RiverShores, TreesStandWhereTheyGrow) {
  const std::vector<CoverRiver> shores = shores_of(
      straight_course(), 0.2, [](glm::dvec2) { return true; },
      [](glm::dvec2 at) { return at.x < 45000.0; });
  double trees[2] = {0.0, 0.0};
  double gravel[2] = {0.0, 0.0};
  for (const CoverRiver& strip : shores)
    for (std::size_t i = 0; i < strip.positions.size(); ++i)
      (strip.painted_as == LandCoverClass::forest
           ? trees
           : gravel)[strip.positions[i].x < 45000.0 ? 0 : 1] +=
          static_cast<double>(strip.half_width_m[i]);
  EXPECT_GT(trees[0], 0.0);
  EXPECT_EQ(trees[1], 0.0);
  EXPECT_GT(gravel[1], 0.5 * gravel[0]);
}

// Breadths are limited in units of the sheet: of a river twice as large on it they are not twice as
// broad there.
TEST(RiverShores, StayNarrowOnTheSheet) {
  const CoverRiver river = straight_course();
  for (const CoverRiver& strip : shores_of(river, 4.0))
    for (const float half : strip.half_width_m) EXPECT_LE(half * 4.0F, 3.4F + 1e-3F);
}

}  // namespace
}  // namespace belvedere
