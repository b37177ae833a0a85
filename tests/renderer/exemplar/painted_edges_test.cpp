#include "renderer/exemplar/painted_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr int edge_width = 120;
constexpr int edge_height = 90;
constexpr float near_m = 1000.F;
constexpr float far_m = 5000.F;

double wavy_ridge(int x) { return 40.0 + 6.0 * std::sin(x / 12.0); }

// A dark ridge before pale land, in strokes; `contrast` 0: of the same paint.
Grid<glm::vec3> painted_ridge(float contrast) {
  Grid<glm::vec3> out(edge_width, edge_height);
  for (int y = 0; y < edge_height; ++y)
    for (int x = 0; x < edge_width; ++x) {
      const glm::vec3 ridge(0.35F, 0.4F, 0.25F), land(0.6F, 0.7F, 0.85F);
      const auto stroke = 0.06F * static_cast<float>(random_uniform(1, x / 2, y) - 0.5);
      out(x, y) = (y > wavy_ridge(x) ? ridge : ridge + contrast * (land - ridge)) + stroke;
    }
  return out;
}

// The ridge as the map has it, that many pixels too low.
Grid<float> mapped_ridge(int too_low, float beyond_m = far_m) {
  Grid<float> out(edge_width, edge_height);
  for (int y = 0; y < edge_height; ++y)
    for (int x = 0; x < edge_width; ++x)
      out(x, y) = y - too_low > wavy_ridge(x) ? near_m : beyond_m;
  return out;
}

Grid<float> within(float radius_px) { return Grid<float>(edge_width, edge_height, radius_px); }

// The first row of the ridge in a column.
int ridge_top(const Grid<float>& depth_m, int x) {
  int y = 0;
  while (y < depth_m.height() && depth_m(x, y) != near_m) ++y;
  return y;
}

TEST(SnapSilhouettes, LieWithinAPixelOfThePaintedEdge) {
  const Grid<glm::vec3> painting = painted_ridge(1.F);
  for (const float beyond_m : {far_m, std::numeric_limits<float>::infinity()})
    for (const int too_low : {4, -5}) {
      const Grid<float> found =
          snap_silhouettes(mapped_ridge(too_low, beyond_m), painting, within(7.F));
      for (int x = 0; x < edge_width; ++x) {
        const int top = ridge_top(found, x);
        EXPECT_NEAR(top, std::floor(wavy_ridge(x)) + 1.0, 1.0) << x;
        for (int y = top; y < edge_height; ++y) ASSERT_EQ(found(x, y), near_m) << x << " " << y;
      }
    }
}

TEST(SnapSilhouettes, StayWhereNoEdgeIsPainted) {
  const Grid<float> mapped = mapped_ridge(4);
  EXPECT_EQ(snap_silhouettes(mapped, painted_ridge(0.F), within(7.F)), mapped);
}

TEST(SnapSilhouettes, StayWhereTheEdgeIsFartherThanTheRadius) {
  // The paint is even within two pixels of the map's ridge.
  const Grid<float> mapped = mapped_ridge(12);
  const Grid<glm::vec3> painting = painted_ridge(1.F);
  EXPECT_EQ(snap_silhouettes(mapped, painting, within(0.F)), mapped);
  EXPECT_EQ(snap_silhouettes(mapped, painting, within(3.F)), mapped);
  EXPECT_NE(snap_silhouettes(mapped, painting, within(14.F)), mapped);
}

TEST(SnapSilhouettes, AreTheSameForAnyThreads) {
  const auto with = [](int threads) {
    const ThreadLimit limit(threads);
    return snap_silhouettes(mapped_ridge(4), painted_ridge(1.F), within(7.F));
  };
  EXPECT_EQ(with(1), with(2));
}

}  // namespace
}  // namespace belvedere
