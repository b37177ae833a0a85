#pragma once

#include "texture/statistical/learn_texture.h"

namespace belvedere {

// Similarity of a texture to its crop: means over clique types of the L1 distance of their
// histograms, 0…2 (HistogramGroups).
struct TextureFigures {
  double selected = 0.0;  // of the types in the model
  double held_out = 0.0;  // of all others within reach: not known to the model
  double worst = 0.0;     // of any single one
  double beyond =
      0.0;  // of the Laplacian at levels 0…2, a clique of five pixels, which no model here contains
  double drawn = 0.0;   // of the coherence of paint directions (structure tensor's
                        // coherence), at levels 0…2
  double turned = 0.0;  // of the directions themselves, in eighths of half a turn, at levels 0…2
};

// For a synthesized picture, or any other, against the crop; `states` (empty: all) selects the
// crop's pixels.
TextureFigures texture_figures(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                               const Grid<Rgb8>& made, const CliqueModel& model,
                               const LearnParameters& parameters);

// The crop's own halves against each other, left and right, top and bottom: the natural lower
// bound. Over uneven_halves the crop is not one texture, or too small to tell.
TextureFigures halves_figures(const Grid<Rgb8>& crop, const CliqueModel& model,
                              const LearnParameters& parameters);
inline constexpr double uneven_halves = .35;

// Side of the largest square of `made` that occurs identically in `crop`, up to 16.
int longest_copy_px(const Grid<Rgb8>& crop, const Grid<Rgb8>& made);

}  // namespace belvedere
