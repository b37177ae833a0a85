#include "renderer/close/raking_light.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/renderer/close/close_ground.h"

namespace belvedere {
namespace {

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
