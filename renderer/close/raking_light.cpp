#include "renderer/close/raking_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/math.h"

namespace belvedere {
namespace {

// The sun is turned until its cosine to the large form lies between these, with their sines.
constexpr float max_facing = 0.62F;
constexpr float max_facing_sine = 0.785F;
constexpr float min_facing = 0.25F;
constexpr float min_facing_sine = 0.968F;
constexpr float wrap = 0.10F;

GroundLight light_of(const ToneParameters& parameters, const GuidanceBuffers& g, std::size_t i) {
  return ground_light(parameters, glm::dvec2(g.position_m[i]) + glm::dvec2(g.origin_m));
}

}  // namespace

SlopeFrame::SlopeFrame(glm::vec3 n) : normal(n) {
  const glm::vec3 fall = glm::vec3(n.x * n.z, n.y * n.z, n.z * n.z - 1.0F);
  const float length = std::sqrt(glm::dot(fall, fall));
  if (length < 1e-4F) return;
  down = fall / length;
  across = glm::cross(n, down);
}

glm::vec3 SlopeFrame::tilted(glm::vec2 gradient, glm::vec2 fall) const {
  constexpr float along = 0.8F;
  const float to_right = gradient.x * fall.y - gradient.y * fall.x;
  const float downhill = along * (gradient.x * fall.x + gradient.y * fall.y);
  return glm::normalize(normal - across * to_right - down * downhill);
}

float RakingLight::facing(glm::vec3 normal) const {
  return unit((glm::dot(normal, sun) + wrap) / (1.0F + wrap));
}

RakingLight raking_light(const ToneParameters& parameters, const GuidanceBuffers& g, std::size_t i,
                         glm::vec3 mean, bool snow) {
  const GroundLight own = light_of(parameters, g, i);
  const glm::vec3 sun(own.sun);
  const float facing = glm::dot(mean, sun);
  RakingLight rake{sun};
  const bool too_near = facing > max_facing;
  if (too_near || (facing < min_facing && !snow)) {
    glm::vec3 across = sun - facing * mean;
    const float length = std::sqrt(glm::dot(across, across));
    constexpr float too_short = 0.05F;
    if (length < too_short) {
      // From where the sun stands above: any side is as good.
      const glm::vec3 side(-mean.y, mean.x, 0.1F);
      across = glm::normalize(side - glm::dot(side, mean) * mean);
    } else {
      across /= length;
    }
    rake.sun = too_near ? max_facing * mean + max_facing_sine * across
                        : min_facing * mean + min_facing_sine * across;
  }
  const float direct = static_cast<float>(parameters.light.sun) * own.strength;
  const float left = 1.0F - static_cast<float>(parameters.light.shadow_depth) *
                                (1.0F - (snow ? smoothstep(0.3F, 0.7F, g.shadow[i]) : g.shadow[i]));
  constexpr float min_strength = 0.34F;  // forms in cast shadow remain
  rake.strength = (snow ? 1.3F * direct * left : std::max(direct * left, min_strength)) / raw_range;
  return rake;
}

RakingLight sun_light(const ToneParameters& parameters, const GuidanceBuffers& g, std::size_t i,
                      float strength) {
  return {glm::vec3(light_of(parameters, g, i).sun), strength};
}

}  // namespace belvedere
