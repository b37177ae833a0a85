#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "renderer/base/guidance_buffers.h"
#include "renderer/base/progress.h"

namespace belvedere {

// The light of look/recipe.md, section Tone: one scalar a pixel from sun, cast shadow, sky view, relief and ribs.
struct ToneParameters {
  glm::dvec3 sun_direction{-0.612, 0.612, 0.5};  // unit, towards the sun
  double sun_strength = 0.80;                    // 0…2
  double sky_strength = 0.30;                    // 0…2
  double relief_strength = 0.08;                 // 0…1
  double shadow_depth = 0.78;                    // how much of the sun a cast shadow takes, 0…1
  double contrast = 1.0;                         // around tone .55, 0.2…3
  double pixels_per_unit = 1.0;                  // as in StrokeParameters
  double wrap = 0.22;                            // light beyond the terminator, 0…1
  std::uint64_t seed = 1;
};

// Reads every traced channel; `origin_px` is where the buffers' (0,0) lies in the whole picture, so that noise stays in place
// in parts of a picture. Local: a pixel depends on neighbours within tone_margin_px() only.
Grid<float> make_tone(const GuidanceBuffers& guidance, const ToneParameters& parameters, glm::ivec2 origin_px, Progress& progress);
int tone_margin_px(const ToneParameters& parameters);

}  // namespace belvedere
