#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "base/guidance_buffers.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/picture_noise.h"
#include "renderer/trace/terrain_model.h"

namespace belvedere {

// The ground's own colours (LandCover::colours): of surface layers, or of an orthophoto. Light
// stays the palette's: a class's ramp is shifted as a whole until it has the ground's colour at the
// tone of level open ground.
struct GroundTint {
  // Colours of one ground, and successive means of 2 × 2 of them: from afar the mean of the ground
  // is seen.
  struct Ground {
    const TerrainModel* model;
    PixelRect part;  // of a window: where its values are valid, in its cells; empty: everywhere
    std::vector<Grid<GroundColour>> means;
  };
  std::vector<Ground> grounds;  // the whole, then windows of increasing resolution
  double lightness = 1.0;       // factor on the colours' lightness, so that the whole is as
                                // light as the palette paints it
  double share = 1.0;           // how far ramps are shifted, 0…1
};

// Null if the terrain has no colours. The terrain must outlive it.
std::shared_ptr<const GroundTint> make_ground_tint(const TerrainModel& terrain,
                                                   const Palette& palette, double share);

// The colour at a position in the scene's CRS where a pixel covers `footprint_m`: encoded sRGB 0…1,
// and how much of it is known, 0…1.
glm::vec4 ground_colour_at(const GroundTint& tint, glm::dvec2 position_m, double footprint_m);

// Depth of a lake at a position in the scene's CRS where its bed is visible, m; 0 where there is
// none.
float lake_depth_at(const GroundTint& tint, glm::dvec2 position_m);

// How a ramp is shifted at a position, in OKLab: its lightness by a factor, its hue by an offset
// that is smaller in shade.
struct TintShift {
  float share = 0.F;         // 0: not at all
  double factor = 1.0;       // of lightness
  glm::dvec2 chroma{0.0};    // added to a, b where the ramp is as light as `reference_l` …
  double reference_l = 1.0;  // … which is its lightness at the tone of level open ground
  glm::vec3 over(glm::vec3 ramp) const;  // encoded sRGB
};
TintShift tint_shift(const GroundTint& tint, const Palette& palette, LandCoverClass id,
                     double altitude_m, glm::dvec3 position_m, double footprint_m);

// Slow changes of colour over the ground, so that no slope has a single hue.

// Noise on the ground, deviation 1, in four sizes (60, 210, 660 and 1800 m). Caches lattice values:
// use one per thread.
struct GroundNoises {
  explicit GroundNoises(std::uint64_t seed);
  GroundNoise n3, n8, n25, n60;
};

// The noise at one position; n3 and n8 fade where their patches become smaller than a stroke.
struct Patches {
  float n3, n8, n25, n60;
};
// `metres_per_unit`: metres of ground in a unit of the sheet (0.5 mm); 0: unknown, nothing fades.
Patches patches_at(GroundNoises& noises, glm::dvec3 position_m, float metres_per_unit);

// Added to the colour of grass, encoded sRGB: whole patches are riper or fresher; high grass is
// fresh where water gathers and bleached on ridges (`relief_s_m`, height above the ground around).
glm::vec3 grass_shift(LandCoverClass id, const Patches& patches, float relief_s_m);

// Slow drift of hue, as colour factors. `strength` is AirParameters::hue_drift, 0…3.
glm::vec3 hue_drift(LandCoverClass id, const Patches& patches, const Palette& palette,
                    float strength);

// Near snow, a colour factor: cream in the sun; steep shade is violet, shade that sees the sky is
// blue. `close`: as close_share.
glm::vec3 near_snow_hue(float tone, float slope_deg, float close);

}  // namespace belvedere
