#pragma once

#include <cstdint>
#include <vector>

#include "texture/synthesis/synth_plane.h"

namespace belvedere::synth {

// Keeps contrast and colour of a class like the exemplar's: patch distance alone prefers flat
// patches. The texels of each class are divided into 8 quantiles of luminance × 8 of local
// contrast; a bin used more often than random picks would use it gets a cost.
inline constexpr int bins_per_class = 64;

// The bin of every texel; 0 outside classes. Luminance is r + g + b, contrast its deviation over 7
// × 7.
std::vector<std::uint8_t> make_bins(const Plane& exemplars, int classes);

// Cost of one more texel from each bin (class × 64 + bin), from its actual and expected uses:
// strength / 16 × clamp(16 (actual - expected) / (expected + 4), -16, 32).
std::vector<std::int32_t> bin_penalties(const std::vector<std::int32_t>& actual,
                                        const std::vector<std::int32_t>& expected,
                                        std::int32_t strength);

// The same with an integral term, as in a controller: a sixteenth of each round's cost is kept,
// within ± 2 × strength, so that the cost of a bin with a steady excess grows until the excess is
// gone. Changes `kept`; the sum of both is the cost.
std::vector<std::int32_t> steer_bins(const std::vector<std::int32_t>& actual,
                                     const std::vector<std::int32_t>& expected,
                                     std::int32_t strength, std::vector<std::int32_t>& kept);

}  // namespace belvedere::synth
