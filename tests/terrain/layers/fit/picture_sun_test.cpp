#include "terrain/layers/fit/picture_sun.h"

#include <gtest/gtest.h>

#include <cmath>

#include "terrain/layers/fit/fit_cells.h"
#include "tests/terrain/layers/fit/synthetic_picture.h"

namespace belvedere {
namespace {

constexpr double pi = 3.14159265358979;

TEST(Sunlight, PlaneHasTheCosineOfIncidence) {
  // Ground that falls to the south by 20°: lit from the south at 40°, cos i = cos 30°.
  Grid<float> plane(40, 40);
  for (int y = 0; y != 40; ++y)
    for (int x = 0; x != 40; ++x)
      plane(x, y) = static_cast<float>(-30.0 * y * std::tan(20.0 * pi / 180.0));
  EXPECT_NEAR(sunlight(plane, 30.0, {180.0, 40.0})(20, 20), std::cos(30.0 * pi / 180.0), 2e-4);
  // From the north at 10° it lies in its own shadow.
  EXPECT_EQ(sunlight(plane, 30.0, {0.0, 10.0})(20, 20), 0.0F);
}

TEST(Sunlight, RidgesThrowShadows) {
  Grid<float> ground(80, 80, 0.0F);
  for (int y = 0; y != 80; ++y)
    for (int x = 38; x != 43; ++x) ground(x, y) = 300.0F;
  const Grid<float> light = sunlight(
      ground, 30.0, {90.0, 20.0});  // from the east: shadow to the west, 300 / tan 20° = 824 m long
  EXPECT_EQ(light(25, 40), 0.0F);
  EXPECT_NEAR(light(5, 40), std::sin(20.0 * pi / 180.0), 1e-3);
  EXPECT_NEAR(light(60, 40), std::sin(20.0 * pi / 180.0), 1e-3);
}

TEST(FindSun, IsTheSunOfAMadeUpPicture) {
  const Grid<float> ground = synthetic::hills(160, 160);
  const synthetic::Picture picture = synthetic::seven_classes(ground, {145.0, 38.0}, 4.0);
  Grid<float> brightness(160, 160);
  for (std::size_t i = 0; i != brightness.size(); ++i)
    brightness[i] = (picture.rgb[i].x + picture.rgb[i].y + picture.rgb[i].z) / 3.0F;
  const Grid<std::uint8_t> use(160, 160, 1);
  const PictureSun by_class =
      find_sun(ground, 30.0, brightness, picture.classes, use, std::nullopt);
  EXPECT_NEAR(by_class.azimuth_deg, 145.0, 5.0);
  EXPECT_NEAR(by_class.elevation_deg, 38.0, 4.0);
  EXPECT_GT(by_class.correlation, 0.8);
  EXPECT_EQ(find_sun(ground, 30.0, brightness, picture.classes, use, 150.0).azimuth_deg, 150.0);
}

TEST(LitEvenly, TakesOutTheLightOfEachClass) {
  const Grid<float> ground = synthetic::hills(160, 160);
  const PictureSun sun{145.0, 38.0};
  const synthetic::Picture picture = synthetic::seven_classes(ground, sun, 2.0);
  const Grid<std::uint8_t> use(160, 160, 1);
  const Grid<float> light = sunlight(ground, 30.0, sun);
  const LightAnswers answers = light_answers(picture.rgb, light, picture.classes, 7, use);
  // Made with .35 + .75 cos i: base / gain = .35 / .75.
  EXPECT_NEAR(answers[1][1].base / answers[1][1].gain, 0.35 / 0.75, 0.03);
  const double level = std::sin(sun.elevation_deg * pi / 180.0);
  const Grid<glm::vec3> even = lit_evenly(picture.rgb, light, level, picture.classes, answers);
  for (std::size_t i = 0; i < light.size(); i += 97) {
    if (picture.classes[i] != 1 || light[i] < 0.1F) continue;
    EXPECT_NEAR(even[i].y, 124.0 * (0.35 + 0.75 * level), 124.0 * 0.15) << i;
  }
  EXPECT_EQ(levelling({0.5, 10.0}, 0.2, 0.6), 1.0);
}

}  // namespace
}  // namespace belvedere
