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
  glm::vec3 image{0.0F};    // what is mirrored
  float image_share = 0.F;  // 0…1
  glm::vec3 bank{0.0F};     // grass and gravel that a brook runs through
  float bank_share = 0.F;   // 0…1
  float tone_shift = 0.F;   // streaks of wind and light
  glm::vec3 shallow{0.0F};  // pale bed seen through
  float shallow_share = 0.F;

  // Laid over the ramp's colour.
  glm::vec3 over(glm::vec3 colour) const;
};

// The look of water pixel i. `around` is the share of water nearby: brooks are thin and lose themselves between gravel and grass, lakes
// mirror. `streak` is noise of deviation 1.
WaterLook water_look(const GuidanceBuffers& guidance, const Palette& palette, const Mirrored& mirrored, std::size_t i, float around,
                     float streak, const Patches& patches);

// The same with a traced image, of pixel `at` of it: `ruffled` (0…1) water shows less of the shore and more of the sky. `deep` (0…1) says
// how far from its shallows a lake is: it is darker there.
struct TracedImage {
  const WaterImage& image;
  std::size_t at;
  float ruffled;
};
WaterLook water_look(const GuidanceBuffers& guidance, const Palette& palette, const Mirrored& mirrored, std::size_t i, float around,
                     float streak, const Patches& patches, const TracedImage& traced);

// Banks of gravel where a river has thrown them up, here and there, 0…0.8; `around` is the share of water nearby.
float gravel_share(float around, const Patches& patches);
// Pale stones at a tone, encoded sRGB.
glm::vec3 gravel_colour(double light);

}  // namespace belvedere
