#include "renderer/exemplar/light/painting_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "base/random.h"
#include "renderer/trace/light_field.h"
#include "tests/renderer/exemplar/painted_hills.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

// Round hills of two classes behind each other, painted in the light of suns by halves of the
// picture, with strokes, air and cast shadows that the estimate does not know.
struct PaintedHills {
  GuidanceBuffers guidance;
  Grid<glm::vec3> picture;
  Grid<std::uint8_t> labels;
};

PaintedHills paint_hills(SunPosition left, SunPosition right) {
  constexpr int width = 240, height = 120;
  PaintedHills out{test::make_slope(width, height, LandCoverClass::rock, {0.F, 0.F, 1.F}, 20.F),
                   Grid<glm::vec3>(width, height), Grid<std::uint8_t>(width, height, 7)};
  GuidanceBuffers& g = out.guidance;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool wood = (x / 30 + y / 30) % 2 == 0;
      const double nx = 0.9 * gaussian_noise(1, x, y, 9.0), ny = 0.9 * gaussian_noise(2, x, y, 9.0);
      const glm::dvec3 normal = glm::normalize(glm::dvec3(nx, ny, 1.0));
      g.normal(x, y) = glm::vec3(normal);
      g.depth_m(x, y) = static_cast<float>(8000.0 + 300.0 * (height - y));
      g.altitude_m(x, y) = static_cast<float>(900.0 + 8.0 * (height - y));
      out.labels(x, y) = wood ? 4 : 7;
      const glm::dvec3 sun = sun_direction(x < width / 2 ? left : right);
      const double shadow = gaussian_noise(3, x, y, 8.0) > 1.2 ? 0.3 : 1.0;
      const double light = shadow * std::max(0.0, glm::dot(normal, sun)) + 0.3 + 0.3 * normal.z;
      const double stroke = 0.15 * (random_uniform(4, x / 2, y) - 0.5);
      const double air = 0.25 * (height - y) / height;
      const double grey =
          std::clamp((wood ? 0.25 : 0.5) * (light + stroke) * (1.0 - air) + 0.7 * air, 0.0, 1.0);
      out.picture(x, y) = glm::vec3(static_cast<float>(grey));
    }
  return out;
}

double azimuth_off(const SunEstimate& found, double azimuth_deg) {
  return std::abs(std::remainder(found.azimuth_deg - azimuth_deg, 360.0));
}

TEST(PaintingLight, FindsTheSunOfAPainting) {
  for (const SunPosition sun : {SunPosition{315.0, 30.0}, {200.0, 40.0}, {75.0, 25.0}}) {
    const PaintedHills hills = paint_hills(sun, sun);
    const PaintingLight found = find_painting_light(hills.picture, hills.labels, hills.guidance);
    EXPECT_LT(azimuth_off(found.whole, sun.azimuth_deg), 10.0) << sun.azimuth_deg;
    EXPECT_NEAR(found.whole.altitude_deg, sun.altitude_deg, 14.0) << sun.azimuth_deg;
    EXPECT_TRUE(found.whole.trusted());
    for (const SunEstimate& region : found.regions)
      EXPECT_TRUE(!region.differs() || azimuth_off(region, sun.azimuth_deg) < 20.0);
  }
}

TEST(PaintingLight, FindsUnlikeSunsByRegion) {
  const PaintedHills hills = paint_hills({300.0, 30.0}, {60.0, 30.0});
  const PaintingLight found =
      find_painting_light(hills.picture, hills.labels, hills.guidance, {.columns = 2, .rows = 1});
  EXPECT_LT(azimuth_off(found.regions(0, 0), 300.0), 10.0);
  EXPECT_LT(azimuth_off(found.regions(1, 0), 60.0), 10.0);
  EXPECT_TRUE(found.regions(0, 0).differs() || found.regions(1, 0).differs());
}

// Paint without any light must not be trusted, nor a few pixels.
TEST(PaintingLight, DoesNotTrustWhatThePaintDoesNotTell) {
  PaintedHills hills = paint_hills({315.0, 30.0}, {315.0, 30.0});
  for (int y = 0; y < hills.picture.height(); ++y)
    for (int x = 0; x < hills.picture.width(); ++x)
      hills.picture(x, y) =
          glm::vec3(0.5F + 0.2F * static_cast<float>(random_uniform(9, x / 4, y / 4) - 0.5));
  const PaintingLight none = find_painting_light(hills.picture, hills.labels, hills.guidance);
  EXPECT_FALSE(none.whole.trusted());
  std::fill(hills.labels.begin(), hills.labels.end(), unused_label);
  EXPECT_EQ(find_painting_light(hills.picture, hills.labels, hills.guidance).whole.pixels, 0U);
}

TEST(PaintingLight, SameBitsForOneAndTwoThreads) {
  const PaintedHills hills = paint_hills({315.0, 30.0}, {20.0, 30.0});
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    const PaintingLight found = find_painting_light(hills.picture, hills.labels, hills.guidance);
    return std::pair(found.whole.azimuth_deg, found.regions(3, 1).trust());
  };
  EXPECT_EQ(with(1), with(2));
}

}  // namespace
}  // namespace belvedere
