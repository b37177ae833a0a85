#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "base/guidance_buffers.h"
#include "renderer/paint/ground/ground_tint.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/paint/water/water_ground.h"
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

struct WaterParameters {
  // Source of reflections: "traced", the mirrored ray in the drawn terrain; "column", the far shore
  // in the same column of the picture: fast, for drafts; "none".
  std::string mirror = "traced";
  double mirror_share = 1.0;  // factor on the usual strength of the reflection, 0…2
  double wind = 1.0;          // 0 smooth … 2 ruffled patches and streaks of light
  bool beds = true;  // lake beds show near the shores; water deepens from turquoise to blue
  double surf_mm =
      0.5;  // width of the broken line of surf along the sea's shores, mm of the sheet; 0 none, …3
  bool foam = true;  // white water where rivers are steep
};

// Where wind ruffles a lake: patches on the ground that do not move with the view. Use one per
// thread.
struct WaterWind {
  explicit WaterWind(std::uint64_t seed);
  // 0 smooth … 1 ruffled, at a position with so many metres of ground in a unit of the sheet; forms
  // smaller than a stroke are left out. `strength` is WaterParameters::wind.
  float ruffled(glm::dvec3 position_m, float metres_per_unit, float strength);

 private:
  GroundNoise broad_, fine_;
};

// Ice of lakes: pale blue grey, snow drifts, few cracks, and a darker line of wet ice along the
// shore. Use one per thread.
struct LakeIce {
  explicit LakeIce(std::uint64_t seed);
  // Encoded sRGB at a light, of ice over water of that depth; `metres_per_unit` as elsewhere.
  glm::vec3 colour(const Palette& palette, double altitude_m, double light, glm::dvec3 position_m,
                   float depth_m, float metres_per_unit);

 private:
  GroundNoise drifts_, small_drifts_, cracks_, stretches_;
};

// Whether a lake at an altitude is frozen.
inline bool is_frozen(const Palette& palette, double altitude_m) {
  return palette.winter && altitude_m >= palette.lakes_freeze_from_m;
}

// A lake's bed seen through the water: near the shore the bed in the ground's own colours, then
// pale water, then the palette's colour.
struct LakeBed {
  float depth_m = 0.F;  // 0: the bed is not visible
  TintShift tint;       // of debris, the class that a bed is painted as
  float share = 0.F;    // how far water takes the colour of what is seen through it, 0…1

  // Applied to a colour of water (encoded sRGB) at a light.
  glm::vec3 under(glm::vec3 water, const Palette& palette, double altitude_m, double light) const;
};

// Painted water (encoded sRGB) without a visible bed: greener by as much as orthophotos show, and
// lighter by half as much.
glm::vec3 shallow_water(glm::vec3 water);

// Where the tint has no bed: inferred from the banks, in the palette's colours. Where a unit of the
// sheet covers many metres, depths are painted smaller than they are, so that shallows keep a
// visible width.
LakeBed lake_bed(const Palette& palette, const WaterGround::Place& water, float metres_per_unit);
// At a water position in the scene's CRS where a pixel covers `footprint_m`. In winter lakes are
// dark.
LakeBed lake_bed(const GroundTint& tint, const Palette& palette, double altitude_m,
                 glm::dvec3 position_m, double footprint_m);

// Noises of painted water; use one set per thread.
struct WaterNoises {
  explicit WaterNoises(std::uint64_t seed) : wind(seed), ice(seed) {}
  WaterWind wind;
  LakeIce ice;
};

// Inputs common to all water of a picture.
struct WaterSources {
  const GuidanceBuffers& guidance;
  const Palette& palette;
  const WaterParameters& parameters;
  const GroundTint* tint = nullptr;  // the ground's own colours; null: none
};

// A pixel of water.
struct WaterPixel {
  std::size_t index;          // in the buffers
  glm::dvec3 position_m;      // in the scene's CRS
  float metres_per_unit;      // ground in a unit of the sheet
  WaterGround::Place ground;  // what lies below it; depth 0 where unknown
  const Mirrored& mirrored;
  float river = 0.0F;  // 1 a river … 0 a lake, or unknown
  float share;         // of water around, on the same surface
  float streak;        // noise, -1 … 1
  const Patches& patches;
  const WaterImage* image = nullptr;  // the reflection; null: it is looked up in the pixel's
                                      // column, unless nothing shall be mirrored
  std::size_t image_index = 0;
};

// The paint of a pixel of water.
struct WaterSurface {
  WaterLook look;
  LakeBed bed;
  float depth_m = 0.0F;
  float frozen = 0.0F;  // share of ice
};
WaterSurface water_surface(const WaterSources& water, WaterNoises& noises, const WaterPixel& pixel);

// Lays the ice of a frozen lake over a colour; `light` as for palettes.
glm::vec3 frozen_over(const glm::vec3& colour, const WaterSources& water, WaterNoises& noises,
                      const WaterPixel& pixel, const WaterSurface& surface, double light);

// Water that flows: dark teal pools in its middle, and between them riffles that break in light
// dashes. `around` is the share of water nearby, `streak` noise of deviation 1, `river` 0 a lake …
// 1 a river.
WaterLook with_current(WaterLook look, float around, float streak, const Patches& patches,
                       float river);

}  // namespace belvedere
