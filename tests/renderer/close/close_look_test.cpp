#include "renderer/close/close_look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/renderer/close/close_ground.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

TEST(CloseLook, CoversAreThoseThatSeasonsLeaveBare) {
  EXPECT_EQ(close_cover(Class::glacier, false), CloseCover::snow);
  EXPECT_EQ(close_cover(Class::scree, false), CloseCover::scree);
  EXPECT_EQ(close_cover(Class::pasture, false), CloseCover::grass);
  EXPECT_EQ(close_cover(Class::pasture, true), CloseCover::snow);
  EXPECT_EQ(close_cover(Class::forest, true), CloseCover::other);
  EXPECT_EQ(close_cover(Class::rock, false), CloseCover::other);
}

// All close forms on a slope.
struct SlopeScene {
  WideView wide;
  Grid<glm::vec2> fall;
  RockParameters parameters = test::close_parameters(1.0);
  SpurGround ground;
  DebrisCones cones;
  CloseScene scene;

  explicit SlopeScene(const GuidanceBuffers& g)
      : wide{g, 1, {0, 0}},
        fall(smooth_fall_lines(wide, 1.0, {0, 0, g.width(), g.height()})),
        ground{wide, fall, 1.0, 5},
        scene(make_close_scene(g, parameters, ground, cones, {0, 0}, {0, 0, g.width(), g.height()},
                               {true, true, true, true})) {}
  SlopeScene(const SlopeScene&) = delete;
  SlopeScene& operator=(const SlopeScene&) = delete;
};

// Deviation of the tone that forms add to an even slope of snow of this normal and shadow.
double modelling(glm::vec3 normal, float shadow, CloseCover cover) {
  constexpr int side = 90;
  GuidanceBuffers g = test::make_slope(side, side, Class::snow, normal, 35.0F);
  for (float& s : g.shadow) s = shadow;
  for (float& metres : g.footprint_m) metres = 6.0F;
  const SlopeScene made(g);
  double squares = 0.0;
  for (int y = 0; y < side; y += 3)
    for (int x = 0; x < side; x += 3) {
      const double tone =
          static_cast<double>(look_at_form(made.scene, x, y, cover, {0.5, 0.5}).tone);
      squares += tone * tone;
    }
  return std::sqrt(squares / (30.0 * 30.0));
}

// Tilted by 15° a slope that faces the sun loses only .03 of its light: the sun is turned instead.
TEST(CloseLook, ASlopeThatFacesTheSunIsModelled) {
  const glm::vec3 sun(ToneParameters{}.sun_direction);
  EXPECT_GT(modelling(glm::normalize(sun), 1.0F, CloseCover::snow), 0.05);
}

TEST(CloseLook, FormsOfStoneRemainInCastShadow) {
  const glm::vec3 north = glm::normalize(glm::vec3(-0.5F, 0.5F, 0.8F));
  const double lit = modelling(north, 1.0F, CloseCover::scree);
  const double shaded = modelling(north, 0.0F, CloseCover::scree);
  EXPECT_GT(lit, 0.02);
  EXPECT_GT(shaded, 0.25 * lit);
  EXPECT_LT(shaded, lit);
}

// Beside a glacier rubble lies in a ridge: light on one side and dark on the other; farther off
// nothing changes.
TEST(CloseLook, GlaciersHaveLateralMoraines) {
  constexpr int side = 120;
  const auto tones = [](Class beside) {
    GuidanceBuffers g = test::make_slope(side, side, Class::scree,
                                         glm::normalize(glm::vec3(0.1F, -0.4F, 0.9F)), 25.0F);
    for (float& metres : g.footprint_m) metres = 6.0F;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < 50; ++x) g.land_cover(x, y) = beside;
    const SlopeScene made(g);
    Grid<float> tone(side, side, 0.0F);
    for (int y = 0; y < side; ++y)
      for (int x = 50; x < side; ++x)
        tone(x, y) = look_at_form(made.scene, x, y, CloseCover::scree, {0.5, 0.5}).tone;
    return tone;
  };
  const Grid<float> beside_ice = tones(Class::glacier);
  const Grid<float> beside_grass = tones(Class::alpine_grass);
  int lighter = 0, darker = 0;
  for (int y = 10; y < side - 10; ++y)
    for (int x = 50; x < side; ++x) {
      const float more = beside_ice(x, y) - beside_grass(x, y);
      if (x > 66) {
        ASSERT_EQ(more, 0.0F);
      }
      lighter += more > 0.02F ? 1 : 0;
      darker += more < -0.02F ? 1 : 0;
    }
  EXPECT_GT(lighter, 25);
  EXPECT_GT(darker, 25);
}

}  // namespace
}  // namespace belvedere
