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

// Varied greens: a meadow is lush where water gathers, pale where the sun dries it, brown-olive
// high above the trees, and mown in strips where people live. Relief decides and, for large patches
// only, noise: hues change over a slope, not over a stroke.

// Relief around a piece of grass.
struct MeadowPosition {
  float slope_deg = 0.0F;
  float sunny = 0.0F;       // -1 steep and facing away from the noon sun … 1 steep and facing it
  float relief_s_m = 0.0F;  // height above the mean of the ground around: small forms …
  float relief_m_m = 0.0F;  // … and middle ones
  float valley_height_m = 0.0F;   // above the lowest ground nearby
  float above_treeline_m = 0.0F;  // < 0 below it
};

// Shares of the kinds of meadow, 0…1 each; the rest is meadow in the palette's colour.
struct MeadowMix {
  float lush = 0.0F;
  float dry = 0.0F;
  float high = 0.0F;  // short turf of high ground
  float mown = 0.0F;  // hay parcels
};

// `sunny_side`: 1 where the noon sun stands in the south, -1 in the north.
MeadowPosition meadow_position(const GuidanceBuffers& guidance, std::size_t i, double treeline_m,
                               float sunny_side);
// Zero for classes other than grass.
MeadowMix meadow_mix(LandCoverClass id, const MeadowPosition& position, const Patches& patches);
// Factor of the colour, encoded sRGB. strength 0…3: AirParameters::hue_drift times the palette's
// share.
glm::vec3 meadow_hue(const MeadowMix& mix, float strength);

// How relief changes a wood: trees in gullies stand close, dark and blue; on ribs and shoulders
// they are lighter and warmer. Light alone shows this weakly, because crowns hide the ground.
struct ForestTurn {
  float tone = 0.0F;       // added to the light
  glm::vec3 factor{1.0F};  // of the colour, encoded sRGB
};
// relief_s_m and relief_m_m: height above the mean of the ground around, small and middle forms.
// light: the tone, 0…1; shade is not darkened further, because a wood would lose its forms there.
// strength: as hue_drift, 0…3.
ForestTurn forest_turn(float relief_s_m, float relief_m_m, float light, const Patches& patches,
                       float strength);

}  // namespace belvedere
