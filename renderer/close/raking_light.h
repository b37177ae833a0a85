#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/math.h"
#include "renderer/paint/light.h"

namespace belvedere {

// Directions on the ground that belong to the fall line on the sheet and to its right.
struct SlopeFrame {
  glm::vec3 normal;
  glm::vec3 down{0.0F};
  glm::vec3 across{0.0F};

  explicit SlopeFrame(glm::vec3 n);
  // The normal under a form of this gradient on the sheet.
  glm::vec3 tilted(glm::vec2 gradient, glm::vec2 fall) const;
};

// The light that forms on a large form get.
struct RakingLight {
  glm::vec3 sun;
  float strength = 1.0F;

  float facing(glm::vec3 normal) const;  // 0…1
  // How much lighter a form of that normal is than the ground it lies on.
  float operator()(glm::vec3 form, glm::vec3 ground) const {
    return strength * (facing(form) - facing(ground));
  }
};

// Light at a pixel for forms on a large form of normal `mean`: a sun that stands too high above it
// (or, except on snow, too low behind it) is turned until it rakes.
RakingLight raking_light(const ToneParameters& parameters, const GuidanceBuffers& guidance,
                         std::size_t i, glm::vec3 mean, bool snow);
// The same with the sun where it is.
RakingLight sun_light(const ToneParameters& parameters, const GuidanceBuffers& guidance,
                      std::size_t i, float strength);

}  // namespace belvedere
