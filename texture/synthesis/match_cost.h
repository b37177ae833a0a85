#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/guide_stack.h"
#include "texture/synthesis/match_field.h"

namespace belvedere {

// What a match field costs where it stands, in the units of synthesis (synth_kernel.h: 1 is an eighth of a weighted squared 8-bit
// difference). Costs are of what is asked for, without what synthesis lets pass because no texel could do better. All throw Error(usage)
// where sizes disagree. Pixels without a texel cost 0.

// How often each texel is copied, by exemplar.
std::vector<Grid<std::uint32_t>> texel_uses(const MatchField& matches, const std::vector<Exemplar>& exemplars);

// How ill the 7 × 7 around each pixel fits the 7 × 7 around its texel, in colour and class: seams. `labels` are those that pixels copy
// from (serving_labels of class_supply.h); what lies beyond a silhouette of depth_m (empty: none) does not count.
Grid<float> seam_cost(const MatchField& matches, const std::vector<Exemplar>& exemplars, const Grid<std::uint8_t>& labels,
                      const Grid<float>& depth_m);

// How far the texel's guide is off what the pixel asks for, 0…255.
Grid<std::uint8_t> guide_error(const MatchField& matches, const std::vector<Exemplar>& exemplars, const GuideStack& target,
                               const std::string& guide);
// The price of that error at a weight.
float guide_cost(std::uint8_t error, double weight);

}  // namespace belvedere
