#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "renderer/paint/ground_hues.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/reflection.h"
#include "renderer/paint/water/water_image.h"

namespace belvedere {

// How water differs from its ramp.
struct WaterLook {
  glm::vec3 image{0.0F};    // colour of the reflection
  float image_share = 0.F;  // 0…1
  glm::vec3 bank{0.0F};     // grass and gravel along a brook
  float bank_share = 0.F;   // 0…1
  float tone_shift = 0.F;   // streaks of wind and light
  glm::vec3 shallow{0.0F};  // pale bed seen through the water
  float shallow_share = 0.F;
  glm::vec3 depth{1.0F};    // factor of the colour: teal over the pools of a river
  float white_share = 0.F;  // broken water of riffles

  // Applied to the ramp's colour.
  glm::vec3 over(glm::vec3 colour) const;
};

// The look of water pixel i. `around` is the share of water nearby: brooks are thin and merge into
// gravel and grass, lakes reflect. `streak` is noise of deviation 1.
WaterLook water_look(const GuidanceBuffers& guidance, const Palette& palette,
                     const Mirrored& mirrored, std::size_t i, float around, float streak,
                     const Patches& patches);

// The same with a traced image, at its pixel `at`: `ruffled` (0…1) water shows less of the shore
// and more of the sky. `deep` (0…1) is the distance from a lake's shallows: it is darker there.
struct TracedImage {
  const WaterImage& image;
  std::size_t at;
  float ruffled;
};
WaterLook water_look(const GuidanceBuffers& guidance, const Palette& palette,
                     const Mirrored& mirrored, std::size_t i, float around, float streak,
                     const Patches& patches, const TracedImage& traced);

// Gravel banks of rivers, in places, 0…0.8; `around` is the share of water nearby.
float gravel_share(float around, const Patches& patches);
// Pale stones at a tone, encoded sRGB.
glm::vec3 gravel_colour(double light);

}  // namespace belvedere
