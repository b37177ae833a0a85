#include "terrain/layers/fit/picture_classes.h"

#include <gtest/gtest.h>

#include "base/error.h"
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

}  // namespace
}  // namespace belvedere
