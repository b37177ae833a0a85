#include "renderer/paint/picture_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

TEST(PictureNoise, EqualsTheNoiseOfBase) {
  const Grid<float> grid = make_image_noise(9, {-13, 250}, 70, 40, 1.7, 3.2, 7.0);
  GroundNoise ground(9, 210.0);
  for (const auto [x, y] : test::cells(70, 40)) {
    EXPECT_NEAR(grid(x, y),
                gaussian_noise(9, (x - 13 + 0.5) / 1.7, (y + 250 + 0.5) / 1.7, 3.2, 7.0), 2e-6);
    const double e = 31.0 * x - 700.0, n = -57.0 * y;
    EXPECT_NEAR(ground(e, n), gaussian_noise(9, e, n, 210.0), 2e-6);
  }
}

TEST(PictureNoise, PartEqualsWhole) {
  const Grid<float> whole = make_image_noise(5, {-40, 12}, 90, 60, 2.3, 3.0, 1.5);
  const PixelRect part{17, 23, 71, 50};
  EXPECT_EQ(make_image_noise(5, {-40 + part.x0, 12 + part.y0}, part.width(), part.height(), 2.3,
                             3.0, 1.5),
            test::cut(whole, part));
}

TEST(PictureNoise, HasMeanZeroAndDeviationOne) {
  const Grid<float> noise = make_image_noise(7, {0, 0}, 600, 600, 1.0, 2.0, 4.0);
  double sum = 0.0;
  double squares = 0.0;
  for (const float value : noise) {
    sum += static_cast<double>(value);
    squares += static_cast<double>(value) * value;
  }
  const auto count = static_cast<double>(noise.size());
  EXPECT_NEAR(sum / count, 0.0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.05);
}

// In any order of positions, and after any overwriting of cached lattice values.
TEST(GroundNoise, RemembersNothingThatMatters) {
  GroundNoise often(3, 150.0);
  for (int i = 0; i < 3000; ++i) often(1e3 * i, -7e2 * i);
  for (int i = 0; i < 200; ++i) {
    GroundNoise fresh(3, 150.0);
    const double x = -5e4 + 613.0 * i;
    EXPECT_EQ(often(x, 0.3 * x), fresh(x, 0.3 * x)) << i;
  }
  // Lattice values 1024 rows apart share one slot of the cache.
  const double far_m = 1024.0 * 150.0 * std::sqrt(3.0);
  GroundNoise twice(3, 150.0);
  twice(10.0, 20.0);
  EXPECT_EQ(twice(10.0, 20.0 + far_m), GroundNoise(3, 150.0)(10.0, 20.0 + far_m));
  EXPECT_NE(GroundNoise(4, 150.0)(10.0, 20.0), GroundNoise(3, 150.0)(10.0, 20.0));
}

}  // namespace
}  // namespace belvedere
