#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {

// Slow changes of colour over the ground: no slope is painted in one hue.

// Noise on the ground, deviation 1, in four sizes (60, 210, 660 and 1800 m). Remembers lattice values: one for each thread.
struct GroundNoises {
  explicit GroundNoises(std::uint64_t seed);
  GroundNoise n3, n8, n25, n60;
};

// The noise at one place; n3 and n8 fade where their patches become smaller than a stroke.
struct Patches {
  float n3, n8, n25, n60;
};
// `metres_per_unit` is what a unit of the sheet (0.5 mm) shows; 0: unknown, nothing fades.
Patches patches_at(GroundNoises& noises, glm::dvec3 place_m, float metres_per_unit);

// What is added to the colour of grass, encoded sRGB: whole patches are riper or fresher, and high grass is fresh where water gathers and
// bleached on ridges (`relief_s_m`, height above the ground around).
glm::vec3 grass_shift(LandCoverClass id, const Patches& patches, float relief_s_m);

// Slow drift of hue, as factors of the colour. `strength` is AirParameters::hue_drift, 0…3.
glm::vec3 hue_drift(LandCoverClass id, const Patches& patches, const Palette& palette, float strength);

}  // namespace belvedere
