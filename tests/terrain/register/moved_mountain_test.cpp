#include "terrain/register/moved_mountain.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace belvedere {
namespace {

constexpr double extent_m = 40000.0;

TEST(MovedMountain, NothingIsMovedByWhatIsExpected) {
  const DeformHandle handle = handle_of({{7000.0, 9000.0}, extent_m, {}});
  EXPECT_EQ(handle.centre, glm::dvec2(7000.0, 9000.0));
  EXPECT_DOUBLE_EQ(handle.radius_m, 4400.0);
  EXPECT_DOUBLE_EQ(handle.core_m, 1760.0);
  EXPECT_TRUE(HandleField({handle}).is_identity());
}

TEST(MovedMountain, UnknownsAreInStandardDeviations) {
  const DeformHandle handle =
      handle_of({{0.0, 0.0}, extent_m, {1.0, -1.0, 1.0, 0.01, -0.02, 2.0, -1.0}});
  EXPECT_EQ(handle.centre, glm::dvec2(1200.0, -1200.0));
  EXPECT_NEAR(handle.radius_m, 4400.0 * std::exp(0.35), 1e-9);
  EXPECT_NEAR(handle.move_m.x, 12.0, 0.01);
  EXPECT_NEAR(handle.move_m.y, -24.0, 0.01);
  EXPECT_DOUBLE_EQ(handle.rotate_deg, 50.0);
  EXPECT_DOUBLE_EQ(handle.raise_m, -200.0);
}

// Whatever a fit asks for: positions ahead of the core keep their order.
TEST(MovedMountain, NoMoveFoldsTheGround) {
  const DeformHandle handle = handle_of({{0.0, 0.0}, extent_m, {0.0, 0.0, 0.0, 100.0}});
  EXPECT_LT(glm::length(handle.move_m), (handle.radius_m - handle.core_m) / 1.9);
  const HandleField field({handle});
  double last = -1e9;
  for (double x = -5000.0; x < 5000.0; x += 20.0) {
    const double moved = field.move({x, 0.0}).position.x;
    EXPECT_GT(moved, last);
    last = moved;
  }
}

TEST(MovedMountain, CoresOfSeveralMustNotOverlap) {
  const MovedMountain one{{0.0, 0.0}, extent_m, {}};
  const auto two_at = [&](double distance) {
    return handles_of(std::vector{one, MovedMountain{{distance, 0.0}, extent_m, {}}});
  };
  EXPECT_FALSE(are_apart(two_at(3500.0)));
  EXPECT_TRUE(are_apart(two_at(3600.0)));
  EXPECT_NO_THROW(HandleField(two_at(3600.0)));
}

}  // namespace
}  // namespace belvedere
