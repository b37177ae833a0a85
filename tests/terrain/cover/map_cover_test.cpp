#include "terrain/cover/map_cover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.h"
#include "terrain/cover/land_cover.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using enum LandCoverClass;
using Ring = std::vector<glm::dvec2>;

constexpr glm::dvec2 low(1000.0, 5000.0);
constexpr glm::dvec2 high(3000.0, 6500.0);

Ring box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

// Outline with many corners, partly beyond the ground: star-shaped, so that a closed form gives its
// inside.
Ring star(glm::dvec2 centre, double radius_m, int corners, double depth) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners;
    const double r =
        radius_m * (1.0 + depth * std::sin(5.0 * angle) + 0.3 * depth * std::sin(17.0 * angle));
    ring.push_back(centre + r * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

// By all edges, the slow reference.
bool encloses(const std::vector<Ring>& rings, glm::dvec2 position) {
  bool inside = false;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a = ring[i];
      const glm::dvec2 b = ring[(i + 1) % ring.size()];
      if ((a.y <= position.y) != (b.y <= position.y) &&
          a.x + (position.y - a.y) * (b.x - a.x) / (b.y - a.y) <= position.x)
        inside = !inside;
    }
  return inside;
}

glm::dvec2 anywhere(std::uint64_t i) {
  const double x =
      low.x - 100.0 +
      (high.x - low.x + 200.0) * std::fmod(0.6180339887498949 * static_cast<double>(i), 1.0);
  const double y =
      low.y - 100.0 +
      (high.y - low.y + 200.0) * std::fmod(0.7548776662466927 * static_cast<double>(i), 1.0);
  return {x, y};
}
bool on_ground(glm::dvec2 p) {
  return p.x >= low.x && p.y >= low.y && p.x < high.x && p.y < high.y;
}

TEST(MapCover, AreasOfAnyFormAreExact) {
  const std::vector<std::vector<Ring>> areas = {
      {star({2000.0, 5700.0}, 600.0, 400, 0.4),
       star({2000.0, 5700.0}, 200.0, 60, 0.2)},   // with a hole
      {star({2900.0, 5100.0}, 500.0, 900, 0.3)},  // over the corner of the ground
      {{{1200.0, 5200.0}, {1800.0, 6300.0}, {1200.0, 6300.0}, {1800.0, 5200.0}}},  // crosses itself
      {box(500.0, 4000.0, 1090.0, 7000.0)},   // larger than the ground
      {box(2500.0, 6100.0, 2501.0, 6101.0)},  // smaller than anything
  };
  for (std::size_t a = 0; a < areas.size(); ++a) {
    const MapCover map({{.rings = areas[a], .painted_as = forest, .rank = 0.0, .still = false}}, {},
                       low, high);
    std::size_t hits = 0;
    for (std::uint64_t i = 0; i < 40000; ++i) {
      const glm::dvec2 position = anywhere(i);
      const bool expected = on_ground(position) && encloses(areas[a], position);
      hits += expected ? 1 : 0;
      ASSERT_EQ(map.at(position), expected ? forest : sky)
          << "area " << a << " at " << position.x << ", " << position.y;
    }
    EXPECT_EQ(hits > 100, a != 4);
  }
  const MapCover tiny({{.rings = areas[4], .painted_as = forest, .rank = 0.0, .still = false}}, {},
                      low, high);
  EXPECT_EQ(tiny.at({2500.5, 6100.5}), forest);
}

// An area's corners and edges on whole numbers, where boxes and cells lie as well.
TEST(MapCover, NeighboursLeaveNeitherGapNorOverlap) {
  std::vector<CoverArea> areas;
  for (const auto [x, y] : test::cells(20, 15)) {
    const glm::dvec2 at = low + 100.0 * glm::dvec2(x, y);
    areas.push_back({.rings = {box(at.x, at.y, at.x + 100.0, at.y + 100.0)},
                     .painted_as = (x + y) % 2 == 0 ? forest : pasture});
  }
  const MapCover map(areas, {}, low, high);
  for (const auto [x, y] : test::cells({0, 0, 2000, 1500}, 25)) {
    const glm::dvec2 position = low + glm::dvec2(x + 0.5, y + 0.5);
    ASSERT_EQ(map.at(position), (x / 100 + y / 100) % 2 == 0 ? forest : pasture);
    ASSERT_NE(map.at(low + glm::dvec2(x, y)), sky);  // on the edges themselves
  }
}

TEST(MapCover, HigherRanksLieOnTopAndOfEqualOnesTheLater) {
  const CoverArea wood{.rings = {box(1000, 5000, 2000, 6000)}, .painted_as = forest, .rank = 8.0};
  const CoverArea lake{
      .rings = {box(1200, 5200, 1700, 5700)}, .painted_as = water, .rank = 18.0, .still = true};
  const CoverArea isle{.rings = {box(1400, 5400, 1500, 5500)}, .painted_as = rock, .rank = 18.0};
  const CoverRiver river{.positions = {{1100, 5100}, {2400, 5100}},
                         .half_width_m = {10.F, 30.F},
                         .painted_as = water,
                         .rank = 20.0};
  for (const bool turned : {false, true}) {
    std::vector<CoverArea> areas = {wood, lake, isle};
    if (turned) areas = {lake, isle, wood};
    const MapCover map(areas, {river}, low, high);
    EXPECT_EQ(map.at({1100.0, 5500.0}), forest);
    EXPECT_EQ(map.at({1250.0, 5250.0}), water);
    EXPECT_TRUE(map.is_still({1250.0, 5250.0}));
    EXPECT_EQ(map.at({1450.0, 5450.0}), rock);
    EXPECT_FALSE(map.is_still({1450.0, 5450.0}));
    EXPECT_EQ(map.at({1500.0, 5100.0}), water);
    EXPECT_FALSE(map.is_still({1500.0, 5100.0})) << "rivers are not level";
    EXPECT_EQ(map.at({2200.0, 5100.0}), water);
    EXPECT_EQ(map.at({2200.0, 5200.0}), sky);
  }
}

TEST(MapCover, RiversAreAsWideAsTheyAre) {
  const CoverRiver river{.positions = {{1100, 5100}, {1900, 5900}, {2900, 5900}},
                         .half_width_m = {5.F, 20.F, 40.F},
                         .painted_as = water,
                         .rank = 0.0};
  const MapCover map({}, {river}, low, high);
  std::size_t hits = 0;
  for (std::uint64_t i = 0; i < 60000; ++i) {
    const glm::dvec2 position = anywhere(i);
    bool expected = false;
    for (std::size_t k = 0; k + 1 < river.positions.size(); ++k) {
      const glm::dvec2 along = river.positions[k + 1] - river.positions[k];
      const double t = std::clamp(
          glm::dot(position - river.positions[k], along) / glm::dot(along, along), 0.0, 1.0);
      const double half = (1.0 - t) * river.half_width_m[k] + t * river.half_width_m[k + 1];
      expected = expected || glm::distance(position, river.positions[k] + t * along) <= half;
    }
    hits += expected ? 1 : 0;
    ASSERT_EQ(map.at(position), expected ? water : sky);
  }
  EXPECT_GT(hits, 500U);
}

TEST(MapCover, NothingIsNothing) {
  const MapCover map({}, {}, low, high);
  EXPECT_EQ(map.at({2000.0, 6000.0}), sky);
  EXPECT_EQ(map.at({NAN, 6000.0}), sky);
  EXPECT_EQ(map.at({1e300, -1e300}), sky);
}

LandCover plain(int cells, LandCoverClass of) {
  LandCover cover;
  cover.classes.cells = Grid<LandCoverClass>(cells, cells, of);
  cover.classes.transform = {0.0, 100.0 * cells, 100.0, 100.0};
  return cover;
}

// The outline is the map's own, not that of the cells.
TEST(MapCover, LiesOverClassesWithItsOwnOutline) {
  LandCover cover = plain(20, forest);
  const Ring outline = {{310.0, 310.0}, {1290.0, 420.0}, {705.0, 1333.0}};
  lay_map(cover,
          std::make_shared<const MapCover>(
              std::vector<CoverArea>{{.rings = {outline}, .painted_as = glacier, .rank = 1.0}},
              std::vector<CoverRiver>{}, glm::dvec2(0.0), glm::dvec2(2000.0)));
  for (double y = 3.0; y < 2000.0; y += 7.0)
    for (double x = 3.0; x < 2000.0; x += 7.0)
      ASSERT_EQ(cover.at(x, y), encloses({outline}, {x, y}) ? glacier : forest);
  EXPECT_EQ(cover.classes.cells(7, 13), glacier);
  EXPECT_EQ(cover.below(7, 13), forest);
}

// Inferred lakes give way to known ones; others stay.
TEST(MapCover, InferredWaterByAKnownLakeGoes) {
  LandCover cover = plain(20, pasture);
  for (const auto [x, y] : test::cells({4, 4, 10, 10})) cover.classes.cells(x, y) = water;
  cover.classes.cells(15, 15) = water;
  const CoverArea lake{
      .rings = {box(600, 1100, 900, 1400)}, .painted_as = water, .rank = 1.0, .still = true};
  lay_map(cover,
          std::make_shared<const MapCover>(std::vector<CoverArea>{lake}, std::vector<CoverRiver>{},
                                           glm::dvec2(0.0), glm::dvec2(2000.0)));
  EXPECT_EQ(cover.classes.cells(4, 4), pasture);
  EXPECT_EQ(cover.below(7, 7), pasture);
  EXPECT_EQ(cover.classes.cells(7, 7), water);
  EXPECT_EQ(cover.classes.cells(15, 15), water);
  // An inferred river through a known lake does not affect its shore.
  LandCover other = plain(20, pasture);
  for (int x = 4; x < 10; ++x) other.classes.cells(x, 4) = water;
  lay_map(other, std::make_shared<const MapCover>(
                     std::vector<CoverArea>{},
                     std::vector<CoverRiver>{
                         {.positions = {{0, 1550}, {2000, 1550}}, .half_width_m = {60.F, 60.F}}},
                     glm::dvec2(0.0), glm::dvec2(2000.0)));
  EXPECT_EQ(other.below(4, 4), water);
}

}  // namespace
}  // namespace belvedere
