#pragma once

#include "texture/statistical/learn_texture.h"

namespace belvedere {

// The published method unchanged (Zalesny et al. 2005, steps 1–6): one level, all clique types up
// to sampled_reach_px, initial noise, and only the sampler to make a texture after each added type.
// A reference for small crops: it takes half a minute where the flow takes a second. `types` and
// `enough` of the parameters apply; textures of the model are made by sampling
// (CliqueModel::sampled). Errors as learn_texture, and Error(limit) for crops over 256 pixels on a
// side.
LearnedTexture learn_by_sampling(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                                 const LearnParameters& parameters,
                                 Progress& progress = silent_progress());
inline constexpr int sampled_reach_px = 12;
inline constexpr int max_sampled_px = 256;

}  // namespace belvedere
