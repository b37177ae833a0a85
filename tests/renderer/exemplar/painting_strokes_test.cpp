#include "renderer/exemplar/painting_strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/noise.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

// Strokes about 3 wide and 15 long at `degrees` from the horizontal (clockwise, as y points down),
// with different lightness.
glm::vec3 stroke_at(int x, int y, double degrees, std::uint64_t seed) {
  const double a = degrees * std::numbers::pi / 180.0;
  const double along = std::cos(a) * x + std::sin(a) * y;
  const double across = -std::sin(a) * x + std::cos(a) * y;
  return glm::vec3(static_cast<float>(
      std::clamp(0.5 + 0.12 * gaussian_noise(seed, along / 5.0, across, 3.0), 0.0, 1.0)));
}

TEST(FindStrokeDirection, FollowsPaintedStrokesInEachLabel) {
  Grid<glm::vec3> picture(160, 100);
  Grid<std::uint8_t> labels(160, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 160; ++x) {
      labels(x, y) = x < 80 ? 1 : 2;
      picture(x, y) = stroke_at(x, y, x < 80 ? 60.0 : 110.0, 5) * (x < 80 ? 1.F : 0.4F);
    }
  const Grid<glm::vec2> direction = find_stroke_direction(picture, labels, 4.0);
  for (const auto& [from, degrees] : {std::pair{10, 60.0}, {90, 110.0}}) {
    double off = 0.0;
    int count = 0;
    int none = 0;
    for (int y = 8; y < 92; ++y)
      for (int x = from; x < from + 60; ++x) {
        const glm::vec2 d = direction(x, y);
        if (d == glm::vec2(0.F)) {
          ++none;
          continue;
        }
        ASSERT_NEAR(d.x * d.x + d.y * d.y, 1.F, 1e-4);
        ASSERT_GT(d.y, 0.F);
        off += std::abs(
            std::remainder(std::atan2(d.y, d.x) * 180.0 / std::numbers::pi - degrees, 180.0));
        ++count;
      }
    EXPECT_LT(off / count, 7.0) << degrees;
    EXPECT_LT(none, count / 10) << degrees;
  }
  // The border itself, a strong vertical edge, does not turn strokes.
  for (int y = 20; y < 80; ++y) EXPECT_LT(direction(82, y).x, 0.1F) << y;
}

TEST(FindStrokeDirection, LyingStrokesAndFlatPaintHaveNone) {
  Grid<glm::vec3> picture(80, 60);
  Grid<std::uint8_t> labels(80, 60, 1);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) picture(x, y) = x < 40 ? stroke_at(x, y, 3.0, 9) : glm::vec3(0.5F);
  const Grid<glm::vec2> direction = find_stroke_direction(picture, labels, 6.0);
  int steep = 0;
  for (int y = 5; y < 55; ++y)
    for (int x = 5; x < 30; ++x) steep += direction(x, y) != glm::vec2(0.F) ? 1 : 0;
  EXPECT_LT(steep, 50 * 25 / 10);
  EXPECT_EQ(direction(79, 30), glm::vec2(0.F));
}

}  // namespace
}  // namespace belvedere
