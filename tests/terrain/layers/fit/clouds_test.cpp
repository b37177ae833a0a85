#include "terrain/layers/fit/clouds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace belvedere {
namespace {

// Brown ground with round clouds, each with a dark shadow at one offset; and a white field without
// one.
Grid<glm::vec3> clouded(int shadow_x, int shadow_y, bool shadows) {
  Grid<glm::vec3> picture(240, 200, glm::vec3(140.0F, 110.0F, 80.0F));
  const auto disc = [&](int cx, int cy, int radius, float value) {
    for (int y = cy - radius; y <= cy + radius; ++y)
      for (int x = cx - radius; x <= cx + radius; ++x)
        if (picture.contains(x, y) && (x - cx) * (x - cx) + (y - cy) * (y - cy) <= radius * radius)
          picture(x, y) = glm::vec3(value);
  };
  for (int i = 0; i != 9; ++i) {
    const int x = 50 + static_cast<int>(random_index(150, 3, i, 0));
    const int y = 50 + static_cast<int>(random_index(110, 3, i, 1));
    const int radius = 4 + static_cast<int>(random_index(6, 3, i, 2));
    if (shadows) disc(x + shadow_x, y + shadow_y, radius, 40.0F);
    disc(x, y, radius, 235.0F);
  }
  return picture;
}

TEST(FindClouds, OffsetAndSunAreThoseOfTheShadows) {
  const Clouds clouds = find_clouds(clouded(-24, -32, true), 30.0);
  ASSERT_TRUE(clouds.found);
  EXPECT_EQ(clouds.shadow_x, -24);
  EXPECT_EQ(clouds.shadow_y, -32);
  // Shadows to the north-west: the sun is in the south-east, atan2(24, -32) from north.
  EXPECT_NEAR(clouds.sun_azimuth_deg, 180.0 - std::atan2(24.0, 32.0) * 180.0 / 3.14159265358979,
              1e-9);
  const Grid<glm::vec3> picture = clouded(-24, -32, true);
  for (std::size_t i = 0; i != clouds.cloud.size(); ++i) {
    if (picture[i].x == 235.0F) {
      EXPECT_EQ(clouds.cloud[i], 1);
    }
    if (picture[i].x == 40.0F) {
      EXPECT_EQ(clouds.shadow[i], 1);
    }
    if (clouds.shadow[i] != 0) {
      EXPECT_EQ(picture[i].x, 40.0F);
    }
  }
}

// Snow casts no shadow a kilometre away.
TEST(FindClouds, WhiteWithoutShadowsIsNoCloud) {
  const Clouds clouds = find_clouds(clouded(-24, -32, false), 30.0);
  EXPECT_FALSE(clouds.found);
  for (const std::uint8_t c : clouds.cloud) EXPECT_EQ(c, 0);
}

}  // namespace
}  // namespace belvedere
