#include "terrain/layers/layer_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace belvedere {
namespace {

Grid<float> noise(const LayerNoise& of, const GeoTransform& transform, const PixelRect& cells,
                  std::uint64_t seed = 3) {
  LayerNoiseRows rows(of, seed, transform, cells);
  Grid<float> out(cells.width(), cells.height());
  for (int y = 0; y < cells.height(); ++y) rows.fill(cells.y0 + y, out.row(y));
  return out;
}

TEST(LayerNoise, IsBoundedCentredAndLoudEnough) {
  const Grid<float> n =
      noise({100.0, 4, 1.0, 0.0}, {600'000.0, 5'200'000.0, 5.0, 5.0}, {0, 0, 1000, 1000});
  double sum = 0.0, squares = 0.0;
  for (const float v : n) {
    ASSERT_LE(std::abs(v), 1.F);
    sum += static_cast<double>(v);
    squares += static_cast<double>(v * v);
  }
  const auto count = static_cast<double>(n.size());
  // 53² lattice values of standard deviation .577 in the coarsest octave, 2 / 1.875 of it: the
  // standard deviation of the mean is .012.
  EXPECT_NEAR(sum / count, 0.0, 0.04);
  EXPECT_NEAR(std::sqrt(squares / count), 0.33, 0.04);
}

// Rows in any order and rectangles of any size: lattice rows kept from one row to the next are
// those of the position.
TEST(LayerNoise, IsAFunctionOfThePlaceAlone) {
  const GeoTransform transform{-1234.5, 777.25, 7.0, 9.0};
  const LayerNoise of{50.0, 3, 1.0, 0.0};
  const Grid<float> whole = noise(of, transform, {0, 0, 120, 90});
  LayerNoiseRows rows(of, 3, transform, {11, 0, 97, 90});
  std::vector<float> line(86);
  for (const int y : {50, 3, 4, 5, 89, 88, 0, 40}) {
    rows.fill(y, line.data());
    for (int x = 0; x < 86; ++x)
      ASSERT_EQ(line[static_cast<std::size_t>(x)], whole(11 + x, y)) << x << ' ' << y;
  }
  // The same ground in a raster with another origin.
  const GeoTransform moved{transform.origin_x + 7.0 * 16.0, transform.origin_y - 9.0 * 8.0, 7.0,
                           9.0};
  const Grid<float> other = noise(of, moved, {0, 0, 40, 40});
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) ASSERT_NEAR(other(x, y), whole(x + 16, y + 8), 1e-5);
}

// The Gaussian field is that of base/noise.h, octave by octave.
TEST(LayerNoise, GaussianRowsAreGaussianNoise) {
  const GeoTransform transform{600'000.0, 5'200'000.0, 10.0, 10.0};
  const PixelRect cells{5, 9, 80, 70};
  LayerNoiseRows rows({{5.0, 0.6, 11}, {40.0, 0.8, 12}}, transform, cells);
  std::vector<float> line(75);
  for (int y = 9; y < 70; ++y) {
    rows.fill(y, line.data());
    for (int x = 5; x < 80; ++x) {
      const glm::dvec2 at = transform.to_crs(x, y);
      ASSERT_NEAR(
          line[static_cast<std::size_t>(x - 5)],
          0.6 * gaussian_noise(11, at.x, at.y, 5.0) + 0.8 * gaussian_noise(12, at.x, at.y, 40.0),
          1e-5);
    }
  }
}

// Octaves shorter than a cell are left out: no random values at single positions.
TEST(LayerNoise, OctavesShorterThanACellAreLeftOut) {
  const GeoTransform coarse{0.0, 0.0, 60.0, 60.0};
  for (const float v : noise({60.0, 4, 1.0, 0.0}, coarse, {0, 0, 50, 50})) ASSERT_EQ(v, 0.F);
  const Grid<float> one = noise({120.0, 1, 1.0, 0.0}, coarse, {0, 0, 50, 50});
  const Grid<float> four = noise({120.0, 4, 1.0, 0.0}, coarse, {0, 0, 50, 50});
  EXPECT_GT(*std::max_element(one.begin(), one.end()), 0.3F);
  // The weight among all octaves is unchanged.
  for (std::size_t i = 0; i < one.size(); ++i)
    if (std::abs(one[i]) < 1.F) {
      ASSERT_NEAR(four[i], one[i] * (1.0 / 1.875), 1e-6);
    }
}

}  // namespace
}  // namespace belvedere
