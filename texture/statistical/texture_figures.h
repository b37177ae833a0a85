#pragma once

#include <vector>

#include "texture/statistical/learn_texture.h"

namespace belvedere {

// How near a texture comes to its crop: means over clique types of the L1 distance of their histograms, 0…2 (HistogramGroups).
struct TextureFigures {
  double selected = 0.0;  // of the types in the model
  double held_out = 0.0;  // of all others within reach: what the model was not told
  double worst = 0.0;     // of any single one
  double beyond = 0.0;    // of the Laplacian at levels 0…2, a clique of five pixels, which no model here knows
  double drawn = 0.0;     // of how far paint around a pixel runs one way (structure tensor's coherence), at levels 0…2
  double turned = 0.0;    // of which way it runs there, by directions of an eighth of half a turn, at levels 0…2
};

// Of a picture that was made, or of any other, against the crop; `states` (empty: all) counts the crop's pixels.
TextureFigures texture_figures(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states, const Grid<Rgb8>& made, const CliqueModel& model,
                               const LearnParameters& parameters);

// The crop's own halves against each other, left and right, top and bottom: the floor that nature sets. Over uneven_halves the crop is not
// one texture, or too small to tell.
TextureFigures halves_figures(const Grid<Rgb8>& crop, const CliqueModel& model, const LearnParameters& parameters);
inline constexpr double uneven_halves = .35;

// Side of the largest square of `made` that stands in `crop` with every pixel alike, up to 16.
int longest_copy_px(const Grid<Rgb8>& crop, const Grid<Rgb8>& made);

}  // namespace belvedere
