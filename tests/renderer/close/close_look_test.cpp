#include "renderer/close/close_look.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/grids.h"
#include "tests/renderer/close/close_ground.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

TEST(CloseLook, CoversAreThoseThatSeasonsLeaveBare) {
  EXPECT_EQ(close_cover(Class::glacier, false), CloseCover::snow);
  EXPECT_EQ(close_cover(Class::scree, false), CloseCover::scree);
  EXPECT_EQ(close_cover(Class::pasture, false), CloseCover::grass);
  EXPECT_EQ(close_cover(Class::pasture, true), CloseCover::snow);
  EXPECT_EQ(close_cover(Class::shrub, true), CloseCover::snow);
  EXPECT_EQ(close_cover(Class::forest, true), CloseCover::other);
  EXPECT_EQ(close_cover(Class::rock, false), CloseCover::other);
}

RockParameters seeded(std::uint64_t seed) {
  RockParameters p = test::close_parameters(1.0);
  p.light.seed = seed;
  return p;
}

// All close forms on a slope.
struct SlopeScene {
  WideView wide;
  Grid<glm::vec2> fall;
  RockParameters parameters;
  SpurGround ground;
  DebrisCones cones;
  IceAround ice;
  CloseScene scene;

  explicit SlopeScene(const GuidanceBuffers& g, std::uint64_t seed = 1)
      : wide{g, 1, {0, 0}},
        fall(smooth_fall_lines(wide, 1.0, {0, 0, g.width(), g.height()})),
        parameters(seeded(seed)),
        ground{wide, fall, 1.0, 5},
        ice(look_around_ice(ground, {0, 0, g.width(), g.height()})),
        scene(make_close_scene(g, parameters, ground, cones, ice, {0, 0},
                               {0, 0, g.width(), g.height()}, {true, true, true, true})) {}
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
  for (const auto [x, y] : test::cells({0, 0, side, side}, 3)) {
    const double tone = static_cast<double>(look_at_form(made.scene, x, y, cover, {0.5, 0.5}).tone);
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
  const auto tones = [](Class beside, std::uint64_t seed) {
    GuidanceBuffers g = test::make_slope(side, side, Class::scree,
                                         glm::normalize(glm::vec3(0.1F, -0.4F, 0.9F)), 25.0F);
    for (float& metres : g.footprint_m) metres = 6.0F;
    for (const auto [x, y] : test::cells(50, side)) g.land_cover(x, y) = beside;
    const SlopeScene made(g, seed);
    Grid<float> tone(side, side, 0.0F);
    for (const auto [x, y] : test::cells({50, 0, side, side}))
      tone(x, y) = look_at_form(made.scene, x, y, CloseCover::scree, {0.5, 0.5}).tone;
    return tone;
  };
  // Rows in which one side of the ridge is lit and the other is not, of all rows of some seeds.
  constexpr int seeds = 6;
  constexpr int rows = side - 20;
  int both = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Grid<float> beside_ice = tones(Class::glacier, seed);
    const Grid<float> beside_grass = tones(Class::alpine_grass, seed);
    for (int y = 10; y < side - 10; ++y) {
      bool lighter = false, darker = false;
      for (int x = 50; x < side; ++x) {
        const float more = beside_ice(x, y) - beside_grass(x, y);
        if (x > 66) {
          ASSERT_EQ(more, 0.0F);
        }
        lighter = lighter || more > 0.02F;
        darker = darker || more < -0.02F;
      }
      both += lighter && darker ? 1 : 0;
    }
  }
  // It comes and goes: noise of deviation 1 raises it to its full height above -.2, that is at six
  // places of ten, and partly at three more.
  EXPECT_GT(both, rows * seeds / 2);
  EXPECT_LT(both, rows * seeds);
}

// A dome of snow as large as a slope, facing the sun: full light leaves it blank, local light
// gives it two sides.
TEST(CloseLook, DomesOfSnowHaveTwoSides) {
  constexpr int side = 240;
  const glm::vec3 sun = glm::normalize(glm::vec3(ToneParameters{}.sun_direction));
  const glm::vec3 aside = glm::normalize(glm::vec3(-sun.y, sun.x, 0.1F));
  GuidanceBuffers g = test::make_slope(side, side, Class::snow, sun, 8.0F);
  for (float& metres : g.footprint_m) metres = 6.0F;
  constexpr double length = 160.0;
  const auto lean = [](int x) {
    return std::sin(2.0 * 3.14159265 * (x - side / 2.0) / length);  // by 10° at most
  };
  for (const auto [x, y] : test::cells(side, side)) {
    const glm::vec3 n = glm::normalize(sun + static_cast<float>(0.18 * lean(x)) * aside);
    g.normal(x, y) = g.normal_detail(x, y) = g.normal_smooth(x, y) = n;
  }
  const SlopeScene made(g);
  double sums[2] = {0.0, 0.0};
  int counts[2] = {0, 0};
  for (const auto [x, y] : test::cells({20, 20, side - 20, side - 20}, 3)) {
    if (std::abs(lean(x)) < 0.7) continue;
    const int k = lean(x) > 0.0 ? 1 : 0;
    sums[k] +=
        static_cast<double>(look_at_form(made.scene, x, y, CloseCover::snow, {0.5, 0.5}).tone);
    ++counts[k];
  }
  EXPECT_GT(sums[1] / counts[1], sums[0] / counts[0] + 0.06);
}

TEST(RakingLight, TurnsAwayFromASlopeThatFacesTheSun) {
  const ToneParameters parameters;
  const glm::vec3 sun = glm::normalize(glm::vec3(parameters.sun_direction));
  const GuidanceBuffers g = test::make_slope(4, 4, LandCoverClass::snow, sun, 30.0F);
  const RakingLight rake = raking_light(parameters, g, 5, sun, true);
  EXPECT_NEAR(glm::dot(rake.sun, sun), 0.62F, 1e-3F);
  EXPECT_NEAR(glm::length(rake.sun), 1.0F, 1e-3F);
  // Tilted by 15° towards it a form gains what the true sun would not give.
  const glm::vec3 aside = glm::normalize(rake.sun - 0.62F * sun);
  const glm::vec3 form = glm::normalize(sun + 0.268F * aside);
  EXPECT_GT(rake(form, sun), 0.1F);
  EXPECT_LE(sun_light(parameters, g, 5, rake.strength)(form, sun), 0.0F);
}

TEST(RakingLight, StaysWhereItRakesAndRemainsInShadow) {
  const ToneParameters parameters;
  const glm::vec3 sun = glm::normalize(glm::vec3(parameters.sun_direction));
  const glm::vec3 aside = glm::normalize(glm::cross(sun, glm::vec3(0.0F, 0.0F, 1.0F)));
  const glm::vec3 half = 0.5F * sun + 0.866F * aside;
  GuidanceBuffers g = test::make_slope(4, 4, LandCoverClass::scree, half, 30.0F);
  const RakingLight lit = raking_light(parameters, g, 5, half, false);
  EXPECT_NEAR(glm::dot(lit.sun, sun), 1.0F, 1e-3F);
  for (float& shadow : g.shadow) shadow = 0.0F;
  const RakingLight shaded = raking_light(parameters, g, 5, half, false);
  EXPECT_LT(shaded.strength, lit.strength);
  EXPECT_GT(shaded.strength, 0.25F * lit.strength);
}

// A gradient down the sheet tilts the ground along its fall, one aside across it.
TEST(SlopeFrame, TiltsByGradientsOnTheSheet) {
  const glm::vec3 normal = glm::normalize(glm::vec3(0.0F, -0.5F, 0.8F));
  const SlopeFrame frame(normal);
  EXPECT_NEAR(glm::dot(frame.down, normal), 0.0F, 1e-5F);
  EXPECT_LT(frame.down.z, 0.0F);
  const glm::vec2 fall{0.0F, 1.0F};
  EXPECT_NEAR(glm::dot(frame.tilted({0.0F, 0.0F}, fall), normal), 1.0F, 1e-5F);
  EXPECT_LT(glm::dot(frame.tilted({0.0F, 0.3F}, fall), frame.down), -0.1F);
  EXPECT_NEAR(glm::dot(frame.tilted({0.3F, 0.0F}, fall), frame.down), 0.0F, 1e-5F);
  EXPECT_LT(glm::dot(frame.tilted({0.3F, 0.0F}, fall), frame.across), -0.1F);
}

}  // namespace
}  // namespace belvedere
