#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/trace/light_field.h"
#include "renderer/trace/wide_view.h"

namespace belvedere {

// How strong each part of the light is.
struct LightParameters {
  double sun = 0.80;           // 0…2
  double sky = 0.30;           // 0…2
  double relief = 0.08;        // how much heights are lighter and hollows darker, 0…1
  double shadow_depth = 0.78;  // how much of the sun a cast shadow takes, 0…1
  double contrast = 1.0;       // around tone .55, 0.2…3
  // How tone becomes colour: by the palette's "ramp", or as the "product" of the ground's own colour and light, for comparison.
  std::string model = "ramp";
};

// Raw light that becomes tone 0, how much more becomes tone 1, and the tone that contrast leaves as it is.
inline constexpr float raw_black = 0.14F;
inline constexpr float raw_range = 0.98F;
inline constexpr float middle_tone = 0.55F;
// The raw light that a tone stands for: what the ground's own colour is multiplied with where light is a factor.
constexpr float light_of_tone(float tone) { return raw_black + raw_range * (tone < 0.0F ? 0.0F : tone); }

// An encoded colour times light, as light multiplies: in linear values.
glm::vec3 times_light(const glm::vec3& colour, float light);

// The light of a picture: one scalar a pixel from sun, cast shadow, sky view, relief and ribs. It indexes palette ramps; it is no radiance.
struct ToneParameters {
  LightParameters light;
  glm::dvec3 sun_direction{-0.612, 0.612, 0.5};  // unit, towards the sun (x east, y north, z up)
  double sun_image_x = 1.0;                      // sun_direction · the camera's right: > 0 light from the right of the picture, -1…1
  // Where light differs from place to place: the sunlight of each; none: sun_direction and sun_image_x everywhere.
  std::shared_ptr<const LightField> light_field = nullptr;
  double ribs = 1.0;             // strength of ribs and gullies, 0…3
  double pixels_per_unit = 1.0;  // as in StrokeParameters: pixels in 0.5 mm of the sheet
  double wrap = 0.22;            // light beyond the terminator, 0…1
  bool winter = false;           // open ground lies under snow
  std::uint64_t seed = 1;
};

// The sunlight on the ground at a place.
GroundLight ground_light(const ToneParameters& parameters, glm::dvec2 place_m);

// Tone of every terrain pixel; that of rock comes from its relief (rock_tone) where there is one.
// Of the rest: tone, 0…1.02 (above 1 colours stay those of full light, strokes do not); sky 0. Reads depth, position, the three
// normals, altitude, land cover, shadow, sky view, slope, fall line and relief, all of the buffers' size: Error(bug) otherwise.
// `origin_px` is where the buffers' (0,0) lies in the whole picture, so that noise stays in place in parts of a picture. Local: a pixel
// depends on neighbours within tone_margin_px() only, so a part with that margin equals the whole bit for bit. Of the buffers' pixels only
// those `wanted` (empty: all) are made: the result has their size. Where a wide view is given, it is what must reach so far; the buffers
// themselves need no more than tone_near_margin_px().
Grid<float> make_tone(const GuidanceBuffers& guidance, const WideView& wide, const ToneParameters& parameters, glm::ivec2 origin_px,
                      Progress& progress, PixelRect wanted = {});
Grid<float> make_tone(const GuidanceBuffers& guidance, const ToneParameters& parameters, glm::ivec2 origin_px, Progress& progress,
                      PixelRect wanted = {});
int tone_margin_px(const ToneParameters& parameters);
int tone_near_margin_px(const ToneParameters& parameters);

}  // namespace belvedere
