#include "terrain/cover/floor_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

namespace belvedere {
namespace {

using enum LandCoverClass;

struct Map {
  Dem dem;
  LandCover cover;
};

// 30 m cells; altitude and class by metres east and north of the centre.
Map make_map(int size, const std::function<double(double, double)>& altitude,
             const std::function<LandCoverClass(double, double)>& id) {
  Map map;
  map.dem.altitude_m = Grid<float>(size, size);
  map.dem.filled = Grid<std::uint8_t>(size, size, 0);
  map.dem.transform = {1000.0, 5000.0, 30.0, 30.0};
  map.cover.classes.cells = Grid<LandCoverClass>(size, size);
  map.cover.classes.transform = map.dem.transform;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double e = 30.0 * (x - size / 2);
      const double n = -30.0 * (y - size / 2);
      map.dem.altitude_m(x, y) = static_cast<float>(altitude(e, n));
      map.cover.classes.cells(x, y) = id(e, n);
    }
  return map;
}

double level(double, double) { return 600.0; }

TEST(FloorPlan, GrainFollowsARiver) {
  for (const double degrees : {0.0, 30.0, 90.0, 135.0}) {
    const double a = degrees * 3.14159265 / 180.0;
    const Map map = make_map(120, level, [&](double e, double n) {
      return std::abs(n * std::cos(a) - e * std::sin(a)) < 60.0 ? water : valley_floor;
    });
    const FloorPlan plan = plan_floor(map.cover, map.dem);
    for (const glm::ivec2 position : {glm::ivec2(60, 60), glm::ivec2(66, 52)}) {
      const glm::vec2 grain = plan.grain(position.x, position.y);
      EXPECT_GT(glm::length(grain), 0.5F) << degrees;
      EXPECT_GT(glm::dot(glm::normalize(grain), glm::vec2(std::cos(2.0 * a), std::sin(2.0 * a))),
                0.97F)
          << degrees;
    }
  }
}

TEST(FloorPlan, GrainFollowsTheFootOfTheSlopeWhereNoRiverIs) {
  // A valley that runs from southwest to northeast.
  const auto trough = [](double e, double n) {
    return 600.0 + 0.5 * std::max(0.0, std::abs(n - e) / 1.41421 - 500.0);
  };
  const Map map = make_map(120, trough, [](double, double) { return valley_floor; });
  const glm::vec2 grain = plan_floor(map.cover, map.dem).grain(60, 60);
  EXPECT_NEAR(grain.x, 0.F, 0.1F);
  EXPECT_GT(grain.y, 0.4F);  // twice 45°
}

TEST(FloorPlan, OpenPlainHasNoGrainAndNoHouses) {
  const Map map = make_map(60, level, [](double, double) { return valley_floor; });
  const FloorPlan plan = plan_floor(map.cover, map.dem);
  for (std::size_t i = 0; i < plan.built.size(); ++i) {
    EXPECT_EQ(plan.built[i], 0.F);
    EXPECT_EQ(plan.grain[i], glm::vec2(0.F));
  }
}

TEST(FloorPlan, TownsAreDenserThanVillagesAndInTheirMiddle) {
  const auto built_in_middle = [](double radius_m, double at_m) {
    const Map map = make_map(160, level, [&](double e, double n) {
      return std::hypot(e, n) < radius_m ? settlement : valley_floor;
    });
    return plan_floor(map.cover, map.dem).built(80 + static_cast<int>(at_m / 30.0), 80);
  };
  EXPECT_LT(built_in_middle(180.0, 0.0), 0.4F);
  EXPECT_GT(built_in_middle(180.0, 0.0), 0.2F);
  EXPECT_GT(built_in_middle(1000.0, 0.0), 0.85F);
  EXPECT_LT(built_in_middle(1000.0, 900.0), 0.55F);
}

}  // namespace
}  // namespace belvedere
