#include "renderer/trace/silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr float sky = std::numeric_limits<float>::infinity();

// Depth along the ray of a perspective picture for a level plain, the eye 500 m above it, the
// horizon at row `horizon`; 1000 pixels of focal length; columns from -width/2.
Grid<float> plain(int width, int height, double horizon) {
  Grid<float> depth(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double down = (y + 0.5 - horizon) / 1000.0;
      const double side = (x + 0.5 - width / 2.0) / 1000.0;
      depth(x, y) =
          down > 0.0 ? static_cast<float>(500.0 / down * std::sqrt(1.0 + down * down + side * side))
                     : sky;
    }
  }
  return depth;
}

TEST(Silhouettes, AGrazingPlaneHasNone) {
  // The horizon is just above the picture: from one row to the next the depth falls to a third.
  const Grid<float> depth = plain(80, 60, -0.01);
  EXPECT_GT(depth(40, 0) / depth(40, 1), 2.5F);
  const Grid<float> found = find_silhouettes(depth);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) ASSERT_LT(found(x, y), 0.01F) << x << ' ' << y;
  }
}

TEST(Silhouettes, ATiltedWallHasNone) {
  // A wall seen almost edge-on, its inverse depth linear along x and y.
  Grid<float> depth(100, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 100; ++x)
      depth(x, y) = static_cast<float>(1.0 / (1e-5 + 2e-6 * x + 1e-6 * y));
  }
  const Grid<float> found = find_silhouettes(depth);
  EXPECT_LT(*std::max_element(found.begin(), found.end()), 0.01F);
}

TEST(Silhouettes, AStepMarksItsNearSideOnly) {
  Grid<float> depth(20, 20, 2000.F);
  for (int y = 8; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) depth(x, y) = 1000.F;
  }
  const Grid<float> found = find_silhouettes(depth);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) EXPECT_EQ(found(x, y), y == 8 ? 1.F : 0.F) << x << ' ' << y;
  }
}

TEST(Silhouettes, AreFoundTowardsEachOfTheFourSides) {
  Grid<float> depth(9, 9, 5000.F);
  depth(4, 4) = 3000.F;
  const Grid<float> found = find_silhouettes(depth);
  EXPECT_EQ(std::count_if(found.begin(), found.end(), [](float v) { return v > 0.F; }), 1);
  EXPECT_EQ(found(4, 4), 1.F);
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    Grid<float> half(9, 9, 5000.F);
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x) {
        if ((x - 4) * dx + (y - 4) * dy <= 0) half(x, y) = 3000.F;
      }
    }
    EXPECT_EQ(find_silhouettes(half)(4, 4), 1.F) << dx << ' ' << dy;
  }
}

TEST(Silhouettes, StrengthIsFourteenTimesTheLogRatio) {
  for (const double ratio : {1.01, 1.03, 1.06, 1.0742, 1.2}) {
    Grid<float> depth(10, 10, 1000.F);
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 10; ++x) depth(x, y) = static_cast<float>(1000.0 * ratio);
    }
    EXPECT_NEAR(find_silhouettes(depth)(5, 5), std::min(1.0, 14.0 * std::log(ratio)), 1e-4)
        << ratio;
  }
}

TEST(Silhouettes, EverythingIsNearerThanTheSky) {
  const Grid<float> depth = plain(30, 40, 20.0);
  const Grid<float> found = find_silhouettes(depth);
  for (int x = 0; x < 30; ++x) {
    EXPECT_EQ(found(x, 20), 1.F);
    EXPECT_EQ(found(x, 19), 0.F);
    EXPECT_LT(found(x, 25), 0.01F);
  }
  const Grid<float> nothing = find_silhouettes(Grid<float>(5, 5, sky));
  EXPECT_EQ(*std::max_element(nothing.begin(), nothing.end()), 0.F);
}

TEST(Silhouettes, AHillAgainstAGrazingPlainIsOne) {
  // The plain again, with a near hill in front of its lower half, rounded so that its crest is
  // grazing as well.
  Grid<float> depth = plain(60, 60, 5.0);
  for (int y = 30; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) depth(x, y) = 6000.F + 400.F / static_cast<float>(y - 29);
  }
  const Grid<float> found = find_silhouettes(depth);
  for (int x = 0; x < 60; ++x) {
    EXPECT_GT(found(x, 30), 0.99F) << x;
    EXPECT_LT(found(x, 29), 0.01F) << x;
    EXPECT_LT(found(x, 40), 0.01F) << x;
  }
}

TEST(Silhouettes, TheEdgeOfAPlateauIsNone) {
  // A steep face whose top passes into grazing level ground: a crease in the surface, nothing is
  // hidden.
  Grid<float> depth = plain(40, 60, 10.0);
  for (int y = 30; y < 60; ++y) {
    for (int x = 0; x < 40; ++x)
      depth(x, y) = depth(x, 29) * (1.F - 0.002F * static_cast<float>(y - 29));
  }
  const Grid<float> found = find_silhouettes(depth);
  for (int x = 0; x < 40; ++x) EXPECT_LT(found(x, 30), 0.05F) << x;
}

TEST(Silhouettes, SameBitsForAnyThreadCount) {
  Grid<float> depth(150, 120);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 150; ++x)
      depth(x, y) = static_cast<float>(1000.0 + 200.0 * random_uniform(3, x, y));
  }
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return find_silhouettes(depth);
  };
  EXPECT_EQ(run(1), run(2));
  EXPECT_TRUE(find_silhouettes({}).empty());
}

}  // namespace
}  // namespace belvedere
