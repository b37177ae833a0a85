#pragma once

#include <vector>

#include "base/progress.h"
#include "texture/statistical/band_pyramid.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/learning_round.h"

namespace belvedere {

struct LearnParameters {
  int types = 40;    // max, 16…200: 28 are nearly as good, 60 slightly better
  int levels = 3;    // of the pyramid above the picture itself, 0…4; fewer if the crop is small
  int reach_px = 8;  // of cliques at the finest level
  int coarse_reach = 5;  // of those at coarser levels, in their pixels
  int rounds = 12;       // of the flow after each added type
  double enough = .02;   // Euclidean distance of histograms, of the worst type not included, at
                         // which a level is done
};

struct LearnedTexture {
  CliqueModel model;
  std::vector<LearnedLevel> levels;
};

// Analysis by synthesis (Zalesny et al. 2005, steps 1–6, on a pyramid and with the flow instead of
// the sampler): beginning with plain histograms and nearest neighbours, the type whose histogram
// differs most between the current texture and the crop is added, until all are close enough or the
// budget is used up. `states` (empty: all) selects the crop's pixels. Error(input) for crops under
// 48 pixels on a side or with fewer than 48 × 48 counted pixels, and for crops of a single colour.
LearnedTexture learn_texture(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                             const LearnParameters& parameters,
                             Progress& progress = silent_progress());
inline constexpr int min_crop_px = 48;

// A model without types: the bands, levels and name of a crop, after the checks of learn_texture.
CliqueModel begin_model(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states, int levels);

// All types of a level within a reach: pairs of bands at one pixel, and a half-plane of offsets
// with all pairs of bands.
std::vector<CliqueType> candidate_types(int level, int reach);
int reach_at(const LearnParameters& parameters, int level);

}  // namespace belvedere
