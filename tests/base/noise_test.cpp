#include "renderer/base/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace belvedere {
namespace {

TEST(GaussianNoise, HasMeanZeroAndDeviationOneEverywhere) {
  double sum = 0.0;
  double squares = 0.0;
  constexpr int side = 120;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double n = gaussian_noise(3, x * 7.7, y * 7.7, 2.0);  // far enough apart to be independent
      sum += n;
      squares += n * n;
    }
  }
  EXPECT_NEAR(sum / (side * side), 0.0, 0.03);
  EXPECT_NEAR(squares / (side * side), 1.0, 0.03);
}

TEST(GaussianNoise, RowsEqualSinglePlaces) {
  for (const double sigma : {60.0, 660.0, 7.0}) {
    std::vector<float> row(300);
    gaussian_noise_row(11, -4000.5, 29.3, 300, 5237123.0, sigma, row.data());
    for (int i = 0; i < 300; ++i)
      EXPECT_NEAR(row[static_cast<std::size_t>(i)], gaussian_noise(11, -4000.5 + 29.3 * i, 5237123.0, sigma), 1e-5) << sigma << ' ' << i;
  }
}

}  // namespace
}  // namespace belvedere
