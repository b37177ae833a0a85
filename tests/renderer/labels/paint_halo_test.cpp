#include "renderer/labels/paint_halo.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/common.hpp>

#include "base/grid.h"
#include "base/random.h"

namespace belvedere {
namespace {

Grid<glm::vec3> noise(int width, int height) {
  Grid<glm::vec3> picture(width, height);
  for (std::size_t i = 0; i < picture.size(); ++i)
    for (int c = 0; c < 3; ++c)
      picture[i][c] = static_cast<float>(random_uniform(5, static_cast<std::int64_t>(i), c));
  return picture;
}

TEST(PaintHalo, ContrastIsThatOfWcag) {
  EXPECT_NEAR(contrast(glm::vec3(0.0F), glm::vec3(1.0F)), 21.0, 1e-9);
  EXPECT_NEAR(contrast(glm::vec3(.3F), glm::vec3(.3F)), 1.0, 1e-9);
  EXPECT_NEAR(luminance({0.0F, 1.0F, 0.0F}), .7152, 1e-9);
}

// Whatever is painted, letters have the contrast that is asked for.
TEST(PaintHalo, LettersHaveTheirContrastOnAnyPaint) {
  const HaloAim dark{.letters = {.08F, .09F, .12F}, .contrast = 4.5, .lightens = true};
  const HaloAim light{.letters = {.99F, .98F, .93F}, .contrast = 4.5, .lightens = false};
  const Grid<glm::vec3> paints = noise(40, 40);
  for (std::size_t i = 0; i < paints.size(); ++i) {
    EXPECT_GE(contrast(halo_colour(paints[i], dark), dark.letters), 4.5 - 1e-4);
    EXPECT_GE(contrast(halo_colour(paints[i], light), light.letters), 4.5 - 1e-4);
  }
  for (const float grey : {0.0F, 1.0F}) {
    EXPECT_GE(contrast(halo_colour(glm::vec3(grey), dark), dark.letters), 4.5 - 1e-4);
    EXPECT_GE(contrast(halo_colour(glm::vec3(grey), light), light.letters), 4.5 - 1e-4);
  }
}

// On ground that is light enough the halo is almost the ground, in the same hue.
TEST(PaintHalo, IsThePaintWhereThatIsLightEnough) {
  const glm::vec3 meadow(.72F, .78F, .55F);
  const glm::vec3 halo = halo_colour(meadow, {.letters = glm::vec3(.1F), .contrast = 4.0});
  EXPECT_GT(halo.g, meadow.g);
  for (int c = 0; c < 3; ++c) EXPECT_LT(halo[c] - meadow[c], .06F);
  EXPECT_NEAR(halo.b / halo.g, meadow.b / meadow.g, .02);
}

TEST(PaintHalo, IsALighterGreenOnGreen) {
  const glm::vec3 green(.4F, .55F, .3F);
  const glm::vec3 halo = halo_colour(green, {.letters = glm::vec3(.1F), .contrast = 6.5});
  EXPECT_GT(halo.g, 1.15F * green.g);
  EXPECT_NEAR(halo.b / halo.g, green.b / green.g, .05);
}

TEST(PaintHalo, OfEvenPaintIsEvenAndOfAPointAHill) {
  const Grid<glm::vec3> even(30, 30, glm::vec3(.25F, .5F, .75F));
  const Grid<glm::vec3> same = blurred({even, {0, 0}}, {5, 5, 20, 20}, 3);
  for (std::size_t i = 0; i < same.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(same[i][c], even[0][c], 1e-5F);
  Grid<glm::vec3> point(41, 41, glm::vec3(0.0F));
  point(20, 20) = glm::vec3(1.0F);
  const Grid<glm::vec3> hill = blurred({point, {0, 0}}, {0, 0, 41, 41}, 2);
  EXPECT_GT(hill(20, 20).g, hill(22, 20).g);
  EXPECT_GT(hill(22, 20).g, hill(25, 20).g);
  EXPECT_EQ(hill(20 + halo_reach_px(2) + 1, 20), glm::vec3(0.0F));
  EXPECT_NEAR(hill(22, 20).g, hill(18, 20).g, 1e-6);
}

// The same bits from any window that has the reach, and others with half of it.
TEST(PaintHalo, AnyWindowWithItsReachGivesTheSameBits) {
  const Grid<glm::vec3> picture = noise(90, 80);
  const PixelRect rect{40, 30, 60, 50};
  const Grid<glm::vec3> whole = part_of(blurred({picture, {0, 0}}, {0, 0, 90, 80}, 4), rect);
  const auto through = [&](int reach) {
    const Grid<glm::vec3> window = part_of(picture, grown(rect, reach));
    return blurred({window, {rect.x0 - reach, rect.y0 - reach}}, rect, 4);
  };
  EXPECT_TRUE(through(halo_reach_px(4)) == whole);
  EXPECT_FALSE(through(halo_reach_px(4) / 2) == whole);
}

}  // namespace
}  // namespace belvedere
