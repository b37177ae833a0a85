#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/paint/air.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/light_field.h"

namespace belvedere {

// Strength of each part of the light.
struct LightParameters {
  double sun = 0.80;           // 0…2
  double sky = 0.30;           // 0…2
  double relief = 0.08;        // how much lighter heights and darker hollows are, 0…1
  double shadow_depth = 0.78;  // share of the sunlight that a cast shadow removes, 0…1
  double contrast = 1.0;       // around tone .55, 0.2…3
  // How tone becomes colour: by the palette's "ramp", or as the "product" of the ground's own
  // colour and light, for comparison.
  std::string model = "ramp";
};

// Raw light that becomes tone 0, the range above it up to tone 1, and the tone that contrast leaves
// unchanged.
inline constexpr float raw_black = 0.14F;
inline constexpr float raw_range = 0.98F;
inline constexpr float middle_tone = 0.55F;
// Raw light of a tone: the factor on the ground's own colour where light is a factor.
constexpr float light_of_tone(float tone) {
  return raw_black + raw_range * (tone < 0.0F ? 0.0F : tone);
}

// A change of tone, limited softly to ±max.
inline float soft_limit(float change, float max) {
  const float t = change / max;
  return change / std::sqrt(1.0F + t * t);
}

// An encoded colour times light, multiplied in linear values.
glm::vec3 times_light(const glm::vec3& colour, float light);

// The light of a picture: one scalar per pixel from sun, cast shadow, sky view, relief and ribs. It
// indexes palette ramps; it is not a radiance.
struct ToneParameters {
  LightParameters light;
  glm::dvec3 sun_direction{-0.612, 0.612, 0.5};  // unit, towards the sun (x east, y north, z up)
  double sun_image_x =
      1.0;  // sun_direction · the camera's right, -1…1; > 0: light from the right of the picture
  // Sunlight that varies with position; null: sun_direction and sun_image_x everywhere.
  std::shared_ptr<const LightField> light_field = nullptr;
  double ribs = 1.0;             // strength of ribs and gullies, 0…3
  double pixels_per_unit = 1.0;  // as in StrokeParameters: pixels in 0.5 mm of the sheet
  double wrap = 0.22;            // light beyond the terminator, 0…1
  AirParameters air = {};        // where ranges are far
  bool winter = false;           // open ground is covered by snow
  std::uint64_t seed = 1;
};

// The sunlight on the ground at a position.
GroundLight ground_light(const ToneParameters& parameters, glm::dvec2 position_m);

// White ground: snow and ice, and in winter all open ground.
bool is_white(LandCoverClass id, bool winter);

// Tone of every terrain pixel; that of rock comes from its relief (rock_tone) where there is one.
// Range 0…1.02 (above 1 colours stay those of full light, strokes change); sky 0. Reads depth,
// position, the three normals, altitude, land cover, shadow, sky view, slope, fall line and relief,
// all of the buffers' size: Error(bug) otherwise. `origin_px` is the position of the buffers' (0,0)
// in the whole picture; it keeps noise fixed across parts of a picture. Local: a pixel depends on
// neighbours within tone_margin_px() only, so a part with that margin equals the whole bit for bit.
// Only the `wanted` pixels of the buffers (empty: all) are made; the result has their size. With a
// wide view only that must reach so far; the buffers need no more than tone_near_margin_px().
Grid<float> make_tone(const GuidanceBuffers& guidance, const WideView& wide,
                      const ToneParameters& parameters, glm::ivec2 origin_px, Progress& progress,
                      PixelRect wanted = {});
Grid<float> make_tone(const GuidanceBuffers& guidance, const ToneParameters& parameters,
                      glm::ivec2 origin_px, Progress& progress, PixelRect wanted = {});
int tone_margin_px(const ToneParameters& parameters);
int tone_near_margin_px(const ToneParameters& parameters);

}  // namespace belvedere
