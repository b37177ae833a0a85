#pragma once

#include <cstdint>
#include <vector>

#include "texture/synthesis/synth_plane.h"

namespace belvedere::synth {

// What keeps contrast and colour of a class at the exemplar's: patch distance alone prefers flat patches. The texels of each class
// fall into 8 quantiles of luminance × 8 of local contrast; a bin drawn from more often than picks would draw from it is dear.
inline constexpr int bins_per_class = 64;

// The bin of every texel; 0 outside classes. Luminance is r + g + b, contrast its deviation over 7 × 7.
std::vector<std::uint8_t> make_bins(const Plane& exemplars, int classes);

// Cost of one more texel from each bin (class × 64 + bin), given how often it is used and how often it should be:
// strength / 16 × clamp(16 (actual - expected) / (expected + 4), -16, 32).
std::vector<std::int32_t> bin_penalties(const std::vector<std::int32_t>& actual, const std::vector<std::int32_t>& expected,
                                        std::int32_t strength);

// The same with a memory, as a controller has it: a sixteenth of each round's cost stays, within ± 2 × strength, so that a bin which a
// steady preference draws too often grows dearer until it is not. Changes `kept`; the sum of both is the cost.
std::vector<std::int32_t> steer_bins(const std::vector<std::int32_t>& actual, const std::vector<std::int32_t>& expected,
                                     std::int32_t strength, std::vector<std::int32_t>& kept);

}  // namespace belvedere::synth
