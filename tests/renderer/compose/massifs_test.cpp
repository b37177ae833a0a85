#include "renderer/compose/massifs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

const Anchor* first_of(const Massifs& massifs, AnchorKind kind) {
  for (const Anchor& anchor : massifs.anchors)
    if (anchor.kind == kind) return &anchor;
  return nullptr;
}

TEST(Massifs, ALoneMountainIsFoundAndKnownAsOne) {
  const Massifs massifs = find_massifs(test::cone_region());
  ASSERT_FALSE(massifs.anchors.empty());
  EXPECT_EQ(massifs.main().kind, AnchorKind::summit);
  EXPECT_LT(glm::length(massifs.main().position - test::position_km(30.0, 30.0)), 450.0);
  EXPECT_EQ(massifs.main().rank, 1.0);
  EXPECT_EQ(massifs.lone, 1.0);
  EXPECT_TRUE(massifs.at_the_rim.empty());
}

TEST(Massifs, PeaksOfAChainAreNotAlone) {
  const Massifs massifs = find_massifs(test::chain_region());
  EXPECT_LT(massifs.lone, 0.3);
  std::size_t summits = 0;
  for (const Anchor& a : massifs.anchors) {
    if (a.kind != AnchorKind::summit) continue;
    ++summits;
    EXPECT_NEAR((a.position.y - 5200000.0) / 1000.0, 30.0, 5.0);
    for (const Anchor& b : massifs.anchors)
      if (&a != &b && b.kind == AnchorKind::summit) {
        EXPECT_GT(glm::length(a.position - b.position), 0.14 * 60000.0);
      }
  }
  EXPECT_GE(summits, 3U);
}

TEST(Massifs, ASummitAtTheEdgeIsSaidAndNotTaken) {
  const auto ground = make_coarse_ground(
      test::synthetic_raster(60.0,
                             [](double e, double n) {
                               const double edge = 2500.0 - 250.0 * std::hypot(e - 59.0, n - 30.0);
                               const double inner = 900.0 - 200.0 * std::hypot(e - 25.0, n - 25.0);
                               return 400.0 + std::max({0.0, edge, inner});
                             }),
      300.0);
  const Massifs massifs = find_massifs(ground);
  ASSERT_EQ(massifs.at_the_rim.size(), 1U);
  EXPECT_NEAR(massifs.at_the_rim[0].position.x, 659000.0, 500.0);
  EXPECT_LT(glm::length(massifs.main().position - test::position_km(25.0, 25.0)), 450.0);
}

TEST(Massifs, ACanyonIsFoundWithItsCourseUpwards) {
  const Massifs massifs = find_massifs(test::canyon_region());
  const Anchor* canyon = first_of(massifs, AnchorKind::canyon);
  ASSERT_NE(canyon, nullptr);
  EXPECT_NEAR((canyon->position.x - 600000.0) / 1000.0, 20.0, 1.6);
  EXPECT_NEAR(canyon->stands_m, 600.0, 130.0);
  EXPECT_GT(canyon->along.y, 0.9) << "northwards, where its floor rises";
  EXPECT_EQ(first_of(find_massifs(test::cone_region()), AnchorKind::canyon), nullptr);
}

// A canyon shorter than the circle in which its direction is computed: nothing beyond it counts.
TEST(Massifs, AShortCanyonHasItsOwnDirection) {
  const auto region = [](double sign) {
    return find_massifs(make_coarse_ground(
        test::synthetic_raster(
            40.0,
            [&](double e, double n) {
              const double upland =
                  2000.0 + 25.0 * std::sin(0.9 * e) * std::cos(0.7 * n) + sign * 40.0 * e;
              const double off = std::hypot(std::max(0.0, std::abs(e - 20.0) - 1.2), n - 20.0);
              const double wall = std::clamp((off - 0.3) / 0.5, 0.0, 1.0);
              const double depth = 640.0 - 60.0 * std::abs(e - 20.0);  // most in its middle
              return upland - depth * (1.0 - wall);
            }),
        200.0));
  };
  for (const double sign : {1.0, -1.0}) {
    const Massifs massifs = region(sign);
    const Anchor* canyon = first_of(massifs, AnchorKind::canyon);
    ASSERT_NE(canyon, nullptr);
    EXPECT_GT(sign * canyon->along.x, 0.95) << "to where its floor rises";
  }
}

TEST(Massifs, ABayIsFoundUnderItsMountains) {
  const Massifs massifs = find_massifs(test::coast_region());
  const Anchor* shore = first_of(massifs, AnchorKind::shore);
  ASSERT_NE(shore, nullptr);
  EXPECT_EQ(shore->altitude_m, 0.0);
  EXPECT_GT((shore->position.y - 5200000.0) / 1000.0, 12.0) << "by the land, not out at sea";
  EXPECT_EQ(first_of(find_massifs(test::chain_region()), AnchorKind::shore), nullptr);
}

}  // namespace
}  // namespace belvedere
