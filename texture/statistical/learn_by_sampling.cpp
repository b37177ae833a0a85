#include "texture/statistical/learn_by_sampling.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "base/error.h"
#include "texture/statistical/clique_polish.h"
#include "texture/statistical/learning_round.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {
namespace {

constexpr int max_trial_px = 128;  // side of the evaluated texture
constexpr int first_sweeps = 60;
constexpr int added_sweeps = 30;  // after each type
constexpr std::uint64_t noise_seed = 5;

// The four neighbours within bands, and pairs of bands at one pixel: preselected, as published; and
// plain histograms.
bool preselected(const CliqueType& t) {
  return (t.dx == 0 && t.dy == 0) || (std::abs(t.dx) + std::abs(t.dy) == 1 && t.head == t.tail);
}

}  // namespace

LearnedTexture learn_by_sampling(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                                 const LearnParameters& parameters, Progress& progress) {
  if (std::max(crop.width(), crop.height()) > max_sampled_px)
    throw Error(ErrorKind::limit, "the crop",
                fmt::format("{} × {} pixels", crop.width(), crop.height()),
                fmt::format("{} a side for the published method", max_sampled_px));
  // Requirements on the crop, its bands and its name are the same as for the flow.
  LearnedTexture out;
  CliqueModel& model = out.model;
  model = begin_model(crop, states, 0);
  model.sampled = true;
  model.polish = true;
  const BandPicture example = to_bands(crop, model.bands, states);

  // Step 1.
  std::vector<CliqueCandidate> candidates =
      make_candidates(example, model.bands, candidate_types(0, sampled_reach_px));
  for (CliqueCandidate& c : candidates) {
    c.in = preselected(c.clique.type);
    if (c.in) model.cliques.push_back(c.clique);
  }
  // Step 2.
  FlowState made{{noise_picture(model, std::min(crop.width(), max_trial_px),
                                std::min(crop.height(), max_trial_px), noise_seed)},
                 {}};
  progress.begin("learning by sampling", parameters.types);
  for (int round = 0;; ++round) {
    // Step 6.
    polish(made, model, 0,
           {.sweeps = round == 0 ? first_sweeps : added_sweeps,
            .share_floor = sampler_share_floor,
            .seed = noise_seed + static_cast<std::uint64_t>(round),
            .resolve = false},
           {});
    progress.advance(1.0);
    // Steps 3 to 5.
    const LearningRound found = evaluate_candidates(candidates, made.pyramid[0], model.bands);
    if (found.worst == candidates.size() || found.told.worst_l2 < parameters.enough ||
        model.cliques.size() >= static_cast<std::size_t>(parameters.types)) {
      out.levels.push_back(found.told);
      return out;
    }
    candidates[found.worst].in = true;
    model.cliques.push_back(candidates[found.worst].clique);
  }
}

}  // namespace belvedere
