#include "terrain/shape/coast.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace belvedere {
namespace {

using Row = std::vector<glm::dvec2>;

constexpr glm::dvec2 low{0.0, 0.0};
constexpr glm::dvec2 high{100.0, 60.0};

bool is_sea(const CoastAreas& areas, glm::dvec2 position) {
  bool odd = false;
  for (const Row& ring : areas.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a = ring[i];
      const glm::dvec2 b = ring[(i + 1) % ring.size()];
      if ((a.y <= position.y) != (b.y <= position.y) &&
          position.x < a.x + (position.y - a.y) * ((b.x - a.x) / (b.y - a.y)))
        odd = !odd;
    }
  return odd;
}

// Every position of a 1 m grid is as in `sea`.
void expect_sea(const std::vector<Row>& lines, const std::function<bool(glm::dvec2)>& sea) {
  const CoastAreas areas = close_coast(lines, low, high);
  EXPECT_EQ(areas.problem, "");
  std::size_t wrong = 0;
  for (double y = 0.517; y < high.y; y += 1.0)
    for (double x = 0.493; x < high.x; x += 1.0)
      wrong += is_sea(areas, {x, y}) != sea({x, y}) ? 1 : 0;
  EXPECT_EQ(wrong, 0U);
}

Row reversed(Row row) {
  std::reverse(row.begin(), row.end());
  return row;
}

Row square(glm::dvec2 centre, double half) {  // against the clock
  return {centre + glm::dvec2(-half, -half), centre + glm::dvec2(half, -half),
          centre + glm::dvec2(half, half), centre + glm::dvec2(-half, half),
          centre + glm::dvec2(-half, -half)};
}

TEST(Coast, LandLiesToTheLeftOfALineAcross) {
  const Row north = {{40.0, -20.0}, {40.0, 80.0}};
  expect_sea({north}, [](glm::dvec2 p) { return p.x > 40.0; });
  expect_sea({reversed(north)}, [](glm::dvec2 p) { return p.x < 40.0; });
  const Row east = {{-20.0, 25.0}, {120.0, 25.0}};
  expect_sea({east}, [](glm::dvec2 p) { return p.y < 25.0; });
  expect_sea({reversed(east)}, [](glm::dvec2 p) { return p.y > 25.0; });
}

TEST(Coast, ACornerIsCutOff) {
  const Row line = {{-10.0, 30.0}, {30.0, -10.0}};  // from the left edge to the lower one
  expect_sea({line}, [](glm::dvec2 p) { return p.x + p.y < 20.0; });
  expect_sea({reversed(line)}, [](glm::dvec2 p) { return p.x + p.y > 20.0; });
}

TEST(Coast, PiecesInAnyOrderAreOneLine) {
  const Row a = {{40.0, -20.0}, {40.0, 10.0}};
  const Row b = {{40.0, 10.0}, {60.0, 30.0}};
  const Row c = {{60.0, 30.0}, {60.0, 90.0}};
  const auto sea = [](glm::dvec2 p) { return p.x > std::clamp(30.0 + p.y, 40.0, 60.0); };
  expect_sea({a, b, c}, sea);
  expect_sea({c, a, b}, sea);
  expect_sea({b, c, a}, sea);
}

TEST(Coast, IslandsAndStraits) {
  const auto in = [](glm::dvec2 p, glm::dvec2 m, double h) {
    return std::abs(p.x - m.x) < h && std::abs(p.y - m.y) < h;
  };
  const Row island = square({70.0, 30.0}, 10.0);
  expect_sea({{{40.0, -20.0}, {40.0, 80.0}}, island}, [&](glm::dvec2 p) {
    return p.x > 40.0 && !in(p, {70.0, 30.0}, 10.0);
  });
  expect_sea({island}, [&](glm::dvec2 p) { return !in(p, {70.0, 30.0}, 10.0); });
  expect_sea({reversed(island)}, [&](glm::dvec2 p) { return in(p, {70.0, 30.0}, 10.0); });
  // A strait between two coasts; an island cut by the edge.
  expect_sea({{{40.0, -20.0}, {40.0, 80.0}}, {{60.0, 80.0}, {60.0, -20.0}}},
             [](glm::dvec2 p) { return p.x > 40.0 && p.x < 60.0; });
  expect_sea({square({100.0, 30.0}, 10.0)}, [&](glm::dvec2 p) {
    return !in(p, {100.0, 30.0}, 10.0);
  });
  // A line that leaves the terrain and comes back: two bays.
  expect_sea(
      {{{-10.0, 40.0}, {20.0, 40.0}, {20.0, 80.0}, {50.0, 80.0}, {50.0, 40.0}, {120.0, 40.0}}},
      [](glm::dvec2 p) { return p.y < 40.0 || (p.x > 20.0 && p.x < 50.0); });
}

TEST(Coast, NothingOnTheTerrainIsNoSea) {
  const CoastAreas areas =
      close_coast({{{-50.0, -50.0}, {-50.0, 90.0}}, square({300.0, 30.0}, 10.0)}, low, high);
  EXPECT_EQ(areas.problem, "");
  EXPECT_FALSE(is_sea(areas, {50.0, 30.0}));
}

TEST(Coast, WhatBoundsNothingIsSaid) {
  const CoastAreas ends = close_coast({{{40.0, -20.0}, {40.0, 30.0}}}, low, high);
  EXPECT_THAT(ends.problem, testing::HasSubstr("E 40, N 30"));
  EXPECT_TRUE(ends.rings.empty());
  const CoastAreas alike =
      close_coast({{{40.0, -20.0}, {40.0, 80.0}}, {{60.0, -20.0}, {60.0, 80.0}}}, low, high);
  EXPECT_THAT(alike.problem, testing::HasSubstr("run in the same direction"));
  EXPECT_TRUE(alike.rings.empty());
}

}  // namespace
}  // namespace belvedere
