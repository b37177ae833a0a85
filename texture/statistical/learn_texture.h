#pragma once

#include <cstddef>
#include <vector>

#include "base/progress.h"
#include "texture/statistical/band_pyramid.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/difference_histogram.h"

namespace belvedere {

// The common part of both learning methods in each round (Zalesny et al. 2005, steps 3 to 5): count
// all types in the texture made, and find the one whose histogram is farthest from the crop's.

// A clique type that may be added, with the crop's distribution.
struct CliqueCandidate {
  Clique clique;
  HistogramGroups groups;
  bool in = false;
};

// For the given types, from the crop at their level.
std::vector<CliqueCandidate> make_candidates(const BandPicture& example, const BandSpace& bands,
                                             const std::vector<CliqueType>& types);

// Result of learning a level.
struct LearnedLevel {
  int level = 0;
  int types = 0;             // of this level
  double held_out_l1 = 0.0;  // mean over the types not included
  double worst_l2 = 0.0;     // of these
};

// Distances from the crop for the types not included.
struct LearningRound {
  LearnedLevel told;      // without its level; `types`: those included
  std::size_t worst = 0;  // candidates.size(): all are included, or none differs
};
LearningRound evaluate_candidates(const std::vector<CliqueCandidate>& candidates,
                                  const BandPicture& made, const BandSpace& bands);

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
