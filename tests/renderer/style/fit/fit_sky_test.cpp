#include "renderer/style/fit/fit_sky.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/grids.h"
#include "tests/renderer/style/synthetic_painting.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

const glm::vec3 first_axis(0.06F, 0.0F, 0.02F);
const glm::vec3 second_axis(0.0F, 0.02F, 0.0F);

// A gradient of lightness and two noises along different axes.
Grid<glm::vec3> noisy_sky(int width, int height, double sigma_x, double sigma_y) {
  Grid<glm::vec3> lab(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    lab(x, y) = {0.6F + 0.2F * static_cast<float>(y) / static_cast<float>(height), -0.02F, -0.06F};
    lab(x, y) += static_cast<float>(gaussian_noise(1, x, y, sigma_x, sigma_y)) * first_axis +
                 static_cast<float>(gaussian_noise(2, x, y, sigma_x, sigma_y)) * second_axis;
  }
  return lab;
}

TEST(FitSky, FindsTheAxesOfTwoNoisesTheirSpreadAndLengths) {
  const Grid<glm::vec3> lab = noisy_sky(600, 400, 16.0, 8.0);
  const FittedSky fitted = fit_sky(lab, Grid<std::uint8_t>(600, 400, 0));
  ASSERT_EQ(fitted.sky.changes.size(), 2U);
  const std::array<glm::vec3, 2> axes = {first_axis, second_axis};
  for (std::size_t k = 0; k < 2; ++k) {
    const StyleSkyChange& change = fitted.sky.changes[k];
    EXPECT_GT(std::abs(glm::dot(glm::normalize(change.axis), glm::normalize(axes[k]))), 0.98F) << k;
    // The fit blurs clouds by 1/90 of the width, 6.7 px, which reduces the deviation.
    const double kept =
        std::sqrt(16.0 * 8.0 / std::sqrt((256.0 + 2 * 22.2 / 2) * (64.0 + 2 * 22.2 / 2)));
    EXPECT_NEAR(glm::length(change.axis) / glm::length(axes[k]), kept, 0.2) << k;
    // The autocorrelation of Gaussian noise has fallen to one half at 2 √ln 2 sigmas.
    EXPECT_NEAR(change.length_x * 600.0, 1.665 * std::sqrt(256.0 + 44.4), 7.0) << k;
    EXPECT_NEAR(change.length_y * 400.0, 1.665 * std::sqrt(64.0 + 44.4), 6.0) << k;
    EXPECT_NEAR(change.quantiles[3], 0.0, 0.25);
    EXPECT_NEAR(change.quantiles[5], 1.28, 0.3);
    for (std::size_t q = 1; q < 7; ++q) EXPECT_GT(change.quantiles[q], change.quantiles[q - 1]);
  }
  EXPECT_GT(fitted.sky.changes[0].axis.x, 0.0F);  // towards light
}

TEST(FitSky, MediansAreThoseOfTheCells) {
  Grid<glm::vec3> lab(90, 100);
  for (const auto [x, y] : test::cells(90, 100))
    lab(x, y) = {0.5F + 0.02F * static_cast<float>(y / 20), 0.01F * static_cast<float>(x / 30), 0};
  const FittedSky fitted = fit_sky(lab, Grid<std::uint8_t>(90, 100, 0));
  ASSERT_EQ(fitted.sky.medians.width(), 3);
  ASSERT_EQ(fitted.sky.medians.height(), 5);
  for (const auto [i, j] : test::cells(3, 5)) {
    EXPECT_NEAR(fitted.sky.medians(i, j).x, 0.5F + 0.02F * static_cast<float>(j), 1e-6F);
    EXPECT_NEAR(fitted.sky.medians(i, j).y, 0.01F * static_cast<float>(i), 1e-6F);
  }
  ASSERT_EQ(fitted.gradient.size(), 5U);
  EXPECT_NEAR(fitted.gradient[4].x, 0.58, 1e-6);
  EXPECT_GT(fitted.cloud_light.x, fitted.cloud_shade.x);
}

TEST(FitSky, StreaksAreTheDeviationsOfTheFinerScales) {
  // Noise of sigma 40 px has nothing at 1/90 of the root of the area, 5.4 px; noise of 8 px has.
  const std::array<double, 2> sigmas = {40.0, 8.0};
  std::array<double, 2> finest{};
  for (std::size_t k = 0; k < 2; ++k)
    finest[k] = fit_sky(noisy_sky(600, 400, sigmas[k], sigmas[k]), Grid<std::uint8_t>(600, 400, 0))
                    .sky.changes.front()
                    .streaks[0];
  EXPECT_LT(finest[0], 0.1);
  EXPECT_GT(finest[1], 0.25);
}

// Saw teeth of lightness: steep on one side.
Grid<glm::vec3> saw_sky(bool steep_above) {
  Grid<glm::vec3> lab(400, 200);
  for (const auto [x, y] : test::cells(400, 200)) {
    const double place = (y + 20.0 * gaussian_noise(4, x, 0, 30.0, 30.0)) / 50.0;
    const double t = place - std::floor(place);  // grows downwards
    lab(x, y) = {0.6F + 0.2F * static_cast<float>(steep_above ? 1.0 - t : t), 0.0F, 0.0F};
  }
  return lab;
}

TEST(FitSky, UpperEdgesTellOnWhichSideCloudsAreSteep) {
  const Grid<std::uint8_t> mask(400, 200, 0);
  EXPECT_GT(fit_sky(saw_sky(true), mask).sky.upper_edges, 0.12);
  EXPECT_LT(fit_sky(saw_sky(false), mask).sky.upper_edges, -0.12);
  EXPECT_NEAR(
      fit_sky(noisy_sky(600, 400, 16.0, 8.0), Grid<std::uint8_t>(600, 400, 0)).sky.upper_edges, 0.0,
      0.1);
}

TEST(FitSky, TheClearSkyIsTheBluestPartAndItsShare) {
  Grid<glm::vec3> lab(400, 200, glm::vec3(0.8F, 0.0F, 0.0F));
  for (const auto [x, y] : test::cells(400, 200))
    if (x % 100 < 20) lab(x, y) = {0.7F, 0.0F, -0.08F};  // a fifth
  const StyleSky sky = fit_sky(lab, Grid<std::uint8_t>(400, 200, 0)).sky;
  EXPECT_NEAR(sky.clear.x, -0.1, 0.01);
  EXPECT_NEAR(sky.clear.z, -0.08, 0.01);
  EXPECT_NEAR(sky.clear_share, 0.2, 0.02);
  EXPECT_NEAR(sky.aspect, 2.0, 1e-9);
}

// Cells of the grid without sky take the colour of their row.
TEST(FitSky, CellsBehindMountainsTakeTheirRow) {
  Grid<glm::vec3> lab(90, 100, glm::vec3(0.7F, 0.0F, -0.05F));
  Grid<std::uint8_t> mask(90, 100, 0);
  for (const auto [x, y] : test::cells({0, 60, 60, 100})) {
    mask(x, y) = test::label_of(LandCoverClass::rock);
    lab(x, y) = {0.3F, 0.0F, 0.0F};
  }
  for (const glm::vec3& median : fit_sky(lab, mask).sky.medians) EXPECT_NEAR(median.x, 0.7F, 1e-6F);
}

TEST(FitSky, AFlatSkyHasNoChangesAndNoSkyIsEmpty) {
  const Grid<glm::vec3> flat(80, 60, glm::vec3(0.7F, 0.0F, -0.05F));
  EXPECT_TRUE(fit_sky(flat, Grid<std::uint8_t>(80, 60, 0)).sky.changes.empty());
  const FittedSky none = fit_sky(flat, Grid<std::uint8_t>(80, 60, unused_label));
  EXPECT_TRUE(none.sky.medians.empty());
  EXPECT_TRUE(none.gradient.empty());
}

}  // namespace
}  // namespace belvedere
