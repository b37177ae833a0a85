#include "terrain/layers/fit/picture_haze.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace belvedere {
namespace {

constexpr int size = 120;

// Brown ground with black rocks, from 500 to 3500 m.
Grid<glm::vec3> clear_picture() {
  Grid<glm::vec3> picture(size, size);
  for (std::size_t i = 0; i != picture.size(); ++i) {
    const double u = random_uniform(1, static_cast<std::int64_t>(i), 0);
    picture[i] = u < 0.06 ? glm::vec3(8.F)
                          : glm::vec3(static_cast<float>(u)) * glm::vec3(160.F, 120.F, 80.F) + 20.F;
  }
  return picture;
}

Grid<float> altitudes() {
  Grid<float> altitude_m(size, size);
  for (int y = 0; y != size; ++y)
    for (int x = 0; x != size; ++x)
      altitude_m(x, y) = 500.F + 3000.F * static_cast<float>(x) / static_cast<float>(size - 1);
  return altitude_m;
}

// Known haze is found and taken out, at every altitude.
TEST(PictureHaze, KnownHazeIsRecovered) {
  const Grid<glm::vec3> clear = clear_picture();
  const Grid<float> altitude_m = altitudes();
  constexpr double blue = 40.0;
  const glm::dvec3 added(blue * std::pow(0.45 / 0.65, 4.0), blue * std::pow(0.45 / 0.56, 4.0),
                         blue);
  Grid<glm::vec3> hazy = clear;
  for (std::size_t i = 0; i != hazy.size(); ++i)
    hazy[i] += glm::vec3(added * std::exp(-static_cast<double>(altitude_m[i]) / 8000.0));
  const PictureHaze haze = find_haze(hazy, altitude_m, Grid<std::uint8_t>(size, size, 1));
  for (int c = 0; c != 3; ++c) EXPECT_NEAR(haze.at_sea_level[c], added[c], 0.5) << c;
  const Grid<glm::vec3> found = without_haze(hazy, altitude_m, haze);
  for (std::size_t i = 0; i != found.size(); ++i)
    for (int c = 0; c != 3; ++c) ASSERT_NEAR(found[i][c], clear[i][c], 0.6);
}

TEST(PictureHaze, ClearPicturesStay) {
  const Grid<glm::vec3> clear = clear_picture();
  const PictureHaze haze = find_haze(clear, altitudes(), Grid<std::uint8_t>(size, size, 1));
  EXPECT_EQ(haze.at_sea_level, glm::dvec3(0.0));
  EXPECT_EQ(without_haze(clear, altitudes(), haze), clear);
  EXPECT_EQ(find_haze(clear, altitudes(), Grid<std::uint8_t>(size, size, 0)).at_sea_level.z, 0.0);
}

}  // namespace
}  // namespace belvedere
