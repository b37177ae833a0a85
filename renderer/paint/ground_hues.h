#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {

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
