#include "terrain/layers/fit/picture_classes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "tests/terrain/layers/fit/rand_index.h"
#include "tests/terrain/layers/fit/synthetic_picture.h"

namespace belvedere {
namespace {

TEST(PictureClasses, FindsTheClassesOfAMadeUpPicture) {
  const Grid<float> ground = synthetic::hills(200, 200);
  const synthetic::Picture picture = synthetic::seven_classes(ground, {140.0, 40.0}, 4.0);
  Grid<std::uint8_t> use(200, 200, 1);
  for (int y = 0; y != 200; ++y) use(0, y) = 0;
  PictureClassParameters parameters;
  parameters.chroma_sigma_cells = 0.0;  // not compressed
  const PictureClasses found = picture_classes(picture.rgb, ground, 30.0, use, parameters);
  EXPECT_FALSE(found.clouds.found);
  EXPECT_FALSE(found.lightness);
  EXPECT_NEAR(found.used_share, 0.995, 1e-9);
  EXPECT_EQ(found.labels[0], no_class);  // not in use
  EXPECT_GE(found.classes.size(), 4U);
  EXPECT_GT(test::adjusted_rand_index(found.labels, picture.classes), 0.65);
}

TEST(PictureClasses, OneHueIsDividedByLightness) {
  const Grid<float> ground = synthetic::hills(160, 160);
  Grid<glm::vec3> snow(160, 160);
  for (std::size_t i = 0; i != snow.size(); ++i) {
    const float light = (ground[i] > 0.0F ? 200.0F : 90.0F) +
                        static_cast<float>(4.0 * random_normal(8, static_cast<std::int64_t>(i), 0));
    snow[i] = {0.5F * light, 0.8F * light, light};
  }
  PictureClassParameters parameters;
  parameters.by_lightness = 2;
  const PictureClasses found =
      picture_classes(snow, ground, 30.0, Grid<std::uint8_t>(160, 160, 1), parameters);
  EXPECT_TRUE(found.lightness);
  EXPECT_EQ(found.classes.size(), 2U);
  std::vector<std::uint8_t> got;
  std::vector<std::uint8_t> made;
  for (std::size_t i = 0; i != found.labels.size(); ++i) {
    if (found.labels[i] == no_class) continue;  // in shadow
    got.push_back(found.labels[i]);
    made.push_back(ground[i] > 0.0F ? 1 : 0);
  }
  EXPECT_GT(got.size(), 160U * 160U / 4U);
  EXPECT_GT(test::adjusted_rand_index(got, made), 0.9);
}

TEST(PictureClasses, NothingToLearnFromIsAnError) {
  const Grid<float> ground = synthetic::hills(64, 64);
  const Grid<glm::vec3> grey(64, 64, glm::vec3(90.0F));
  EXPECT_THROW(picture_classes(grey, ground, 30.0, Grid<std::uint8_t>(64, 64, 0)), Error);
  EXPECT_THROW(picture_classes(grey, ground, 30.0, Grid<std::uint8_t>(64, 64, 1)),
               Error);  // one class only
}

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

// With shortwave infrared white is snow where it is dark there, and cloud where it is bright,
// though no shadow matches.
TEST(FindClouds, InfraredTellsSnowFromCloud) {
  const Grid<glm::vec3> picture = clouded(-24, -32, false);
  Grid<float> swir(picture.width(), picture.height(), 90.F);
  for (int y = 0; y != picture.height(); ++y)
    for (int x = 0; x != picture.width(); ++x)
      if (picture(x, y).x == 235.F) swir(x, y) = x < 120 ? 30.F : 220.F;  // snow in the west
  const Clouds clouds = find_clouds(picture, 30.0, {}, &swir);
  EXPECT_TRUE(clouds.found);
  EXPECT_FALSE(clouds.shadows);
  int cloud = 0;
  for (int y = 0; y != picture.height(); ++y)
    for (int x = 0; x != picture.width(); ++x) {
      if (x < 110) {
        ASSERT_EQ(clouds.cloud(x, y), 0) << x << ' ' << y;
      }
      if (x > 130 && picture(x, y).x == 235.F) cloud += clouds.cloud(x, y);
    }
  EXPECT_GT(cloud, 100);
  for (float& value : swir) value = std::min(value, 30.F);
  EXPECT_FALSE(find_clouds(picture, 30.0, {}, &swir).found) << "all is snow";
}

// Found classes: white low down is not snow.
TEST(PictureClasses, WhiteBelowTheLowestSnowIsLeftOut) {
  const Grid<float> ground = synthetic::hills(120, 120);
  synthetic::Picture picture = synthetic::seven_classes(ground, {140.0, 40.0}, 4.0);
  for (std::size_t i = 0; i != ground.size(); ++i)
    if (ground[i] > 300.F || (i % 120 < 12 && ground[i] < 0.F)) picture.rgb[i] = glm::vec3(230.F);
  PictureClassParameters parameters;
  parameters.chroma_sigma_cells = 0.0;
  parameters.snow_from_m = 200.0;
  parameters.clouds.min_match = 2.0;  // no clouds
  const PictureClasses found =
      picture_classes(picture.rgb, ground, 30.0, Grid<std::uint8_t>(120, 120, 1), parameters);
  std::size_t low = 0;
  std::size_t high = 0;
  std::size_t high_found = 0;
  for (std::size_t i = 0; i != ground.size(); ++i)
    if (i % 120 < 12 && ground[i] < 0.F) {
      ++low;
      EXPECT_EQ(found.labels[i], no_class);
    } else if (ground[i] > 300.F) {
      ++high;
      high_found += found.labels[i] != no_class ? 1U : 0U;
    }
  EXPECT_GT(low, 100U);
  EXPECT_GT(static_cast<double>(high_found), 0.8 * static_cast<double>(high));
  EXPECT_GE(found.low_white_share, static_cast<double>(low) / (120.0 * 120.0));
}

// Greys beside a brown so pale that both lie near the centre of the plane: one class as usual, two
// where greys have a hue of their own, as first published.
TEST(PictureClasses, GreysMayHaveAHueOfTheirOwn) {
  const Grid<float> ground = synthetic::hills(100, 100);
  Grid<glm::vec3> picture(100, 100);
  std::vector<std::uint8_t> made;
  for (std::size_t i = 0; i != picture.size(); ++i) {
    const bool grey = i % 100 < 50;
    made.push_back(grey ? 1 : 0);
    const auto noise = [&](int c) {
      return static_cast<float>(1.5 * random_normal(6, static_cast<std::int64_t>(i), c));
    };
    picture[i] = (grey ? glm::vec3(120.F) : glm::vec3(132.F, 122.F, 112.F)) +
                 glm::vec3(noise(0), noise(1), noise(2));
  }
  PictureClassParameters parameters;
  parameters.chroma_sigma_cells = 0.0;
  parameters.grey_hue_deg = 300.0;
  const PictureClasses own =
      picture_classes(picture, ground, 30.0, Grid<std::uint8_t>(100, 100, 1), parameters);
  EXPECT_FALSE(own.lightness);
  EXPECT_GT(test::adjusted_rand_index(own.labels, made), 0.95);
  EXPECT_NEAR(own.grey_share, 0.5, 0.03);
  // Drawn regions see the hue too.
  ColourRegion purple;
  purple.of.name = "grey";
  purple.hue_deg = glm::dvec2(290.0, 310.0);
  ColourRegion rest;
  rest.of.name = "rest";
  parameters.regions = {purple, rest};
  const PictureClasses drawn =
      picture_classes(picture, ground, 30.0, Grid<std::uint8_t>(100, 100, 1), parameters);
  EXPECT_GT(test::adjusted_rand_index(drawn.labels, made), 0.9);
}

// Snow casts no shadow a kilometre away.
TEST(FindClouds, WhiteWithoutShadowsIsNoCloud) {
  const Clouds clouds = find_clouds(clouded(-24, -32, false), 30.0);
  EXPECT_FALSE(clouds.found);
  for (const std::uint8_t c : clouds.cloud) EXPECT_EQ(c, 0);
}

}  // namespace
}  // namespace belvedere
