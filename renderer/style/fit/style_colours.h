#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/land_cover_class.h"
#include "renderer/paint/palette.h"

namespace belvedere {

// Common to the steps of fitting a style. Colours are OKLab (L, a, b); sections (A0…B7) are those
// of the recipe in docs/style.md.

using LabRamp = std::array<glm::dvec3, 4>;                       // at ramp_tones
using ClassRamps = std::array<LabRamp, land_cover_class_count>;  // [sky] unused
using ClassFlags = std::array<bool, land_cover_class_count>;

// Quantiles of lightness at which ramp_tones lie in the program's pictures.
inline constexpr std::array<double, 4> ramp_quantiles = {0.03, 0.19, 0.54, 0.97};
// Share of a panorama's ground near each of ramp_tones.
inline constexpr std::array<double, 4> tone_shares = {0.06, 0.30, 0.44, 0.20};
// Share of a typical panorama's ground that each class covers, by id.
inline constexpr std::array<double, land_cover_class_count> area_shares = {
    0.0, 0.02, 0.06, 0.01, 0.34, 0.14, 0.06, 0.18, 0.06, 0.03, 0.08, 0.02, 0.0};

double chroma(const glm::dvec3& lab);
// Mean weighted with tone_shares; of all classes, also with area_shares.
double mean_lightness(const LabRamp& ramp);
double ground_lightness(const ClassRamps& ramps);

// Colours outside sRGB are clamped.
ToneRamp encoded_ramp(const LabRamp& ramp);
// Of classes with ramps at several altitudes the middle one.
ClassRamps palette_ramps(const Palette& palette);

constexpr std::size_t index_of(LandCoverClass id) { return static_cast<std::size_t>(id); }
// The name of a class in words, such as "alpine grass".
std::string class_words(LandCoverClass id);

}  // namespace belvedere
