#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Costs of a given match field, in the units of synthesis (synth_kernel.h: 1 is an eighth of a
// weighted squared 8-bit difference). Costs are full differences from the request, without the
// tolerance of synthesis for errors that no texel could avoid. All throw Error(usage) if sizes
// differ. Pixels without a texel cost 0.

// How often each texel is copied, by exemplar.
std::vector<Grid<std::uint32_t>> texel_uses(const MatchField& matches,
                                            const std::vector<Exemplar>& exemplars);

// Difference between the 7 × 7 around each pixel and the 7 × 7 around its texel, in colour and
// class: seams. `labels` are those that pixels copy from (serving_labels of class_texels.h); pixels
// beyond a silhouette of depth_m (empty: none) are ignored.
Grid<float> seam_cost(const MatchField& matches, const std::vector<Exemplar>& exemplars,
                      const Grid<std::uint8_t>& labels, const Grid<float>& depth_m);

// Difference between the texel's guide and the pixel's, 0…255; 0 for texels of an exemplar that
// lacks the guide. Error(usage) if the target or every exemplar lacks it.
Grid<std::uint8_t> guide_error(const MatchField& matches, const std::vector<Exemplar>& exemplars,
                               const GuideStack& target, const std::string& guide);
// The price of an error of a guide, at the guide's weight.
float guide_cost(std::uint8_t error, double weight);

}  // namespace belvedere
