#pragma once

#include "texture/statistical/learn_texture.h"

namespace belvedere {

// The published method as it stands (Zalesny et al. 2005, steps 1–6): one level, all clique types up to sampled_reach_px, noise to begin
// with, and the sampler alone to make a texture after each type that is added. An oracle for small crops: it takes half a minute where the
// flow takes a second. `types` and `enough` of the parameters hold; the model is one that is made by sampling (CliqueModel::sampled).
// Errors as learn_texture, and Error(limit) for crops over 256 pixels a side.
LearnedTexture learn_by_sampling(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states, const LearnParameters& parameters,
                                 Progress& progress = silent_progress());
inline constexpr int sampled_reach_px = 12;
inline constexpr int most_sampled_px = 256;

}  // namespace belvedere
