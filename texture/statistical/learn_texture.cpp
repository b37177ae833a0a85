#include "texture/statistical/learn_texture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/cache/content_hash.h"
#include "base/error.h"
#include "base/parallel.h"
#include "texture/statistical/clique_polish.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {

std::vector<CliqueCandidate> make_candidates(const BandPicture& example, const BandSpace& bands,
                                             const std::vector<CliqueType>& types) {
  std::vector<CliqueCandidate> out(types.size());
  parallel_ranges(types.size(), std::size_t{8}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k != end; ++k) {
      const DifferenceHistogram histogram = count_differences(example, bands, types[k]);
      const CliqueKnots knots = find_knots(histogram, difference_range(bands, types[k]));
      out[k] = {{types[k], encode_knots(bands, types[k], knots)}, HistogramGroups(histogram)};
    }
  });
  return out;
}

LearningRound evaluate_candidates(const std::vector<CliqueCandidate>& candidates,
                                  const BandPicture& made, const BandSpace& bands) {
  std::vector<HistogramGroups::Distance> off(candidates.size());
  parallel_ranges(candidates.size(), std::size_t{8}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k != end; ++k)
      if (!candidates[k].in)
        off[k] = candidates[k].groups.distance(
            count_differences(made, bands, candidates[k].clique.type));
  });
  LearningRound round{{}, candidates.size()};
  double sum = 0.0;
  int held = 0;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (candidates[k].in) {
      ++round.told.types;
      continue;
    }
    sum += off[k].l1;
    ++held;
    if (off[k].l2 <= round.told.worst_l2) continue;
    round.told.worst_l2 = off[k].l2;
    round.worst = k;
  }
  round.told.held_out_l1 = held > 0 ? sum / held : 0.0;
  return round;
}

namespace {

constexpr std::uint64_t learning_seed = 5;

// Always included: each band's own histogram; at the finest level also the pairs at one pixel and
// the four neighbours; above it only the first band's histogram, because the others follow from it
// and from the added types.
bool always_in(const CliqueType& t) {
  if (t.level > 0) return t.single() && t.head == 0;
  const bool near = std::abs(t.dx) + std::abs(t.dy) == 1 && t.head == t.tail;
  return (t.dx == 0 && t.dy == 0) || near;
}

void check_crop(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states) {
  const auto refuse = [](const std::string& found, const std::string& allowed) {
    throw Error(ErrorKind::input, "the crop", found, allowed);
  };
  if (static_cast<std::int64_t>(crop.size()) > max_texture_pixels)
    throw Error(ErrorKind::limit, "the crop",
                fmt::format("{} × {} pixels", crop.width(), crop.height()),
                fmt::format("at most {} Mpixels: a piece that shows a single texture",
                            max_texture_pixels >> 20));
  if (crop.width() < min_crop_px || crop.height() < min_crop_px)
    refuse(fmt::format("{} × {} pixels", crop.width(), crop.height()),
           fmt::format("at least {} pixels on each side", min_crop_px));
  if (!states.empty() && !states.same_size(crop))
    refuse(fmt::format("the mask has {} × {} pixels, the crop {} × {}", states.width(),
                       states.height(), crop.width(), crop.height()),
           "a mask of the crop's size");
  std::size_t counted = 0;
  bool varied = false;
  Rgb8 first{};
  for (std::size_t i = 0; i < crop.size(); ++i) {
    if (!states.empty() && (states[i] & pixel_counts) == 0) continue;
    if (counted++ == 0) first = crop[i];
    varied |= crop[i] != first;
  }
  constexpr std::size_t min = std::size_t{min_crop_px} * min_crop_px;
  if (counted < min)
    refuse(fmt::format("{} pixels that are opaque and in its mask", counted),
           fmt::format("at least {}", min));
  if (!varied) refuse("it has a single colour", "a texture");
}

std::string hash_of(const Grid<Rgb8>& crop) {
  ContentHash hash;
  hash.add(crop.data(), crop.size() * sizeof(Rgb8));
  return hash.digits();
}

// Coarse levels need enough pixels to count.
int levels_for(const Grid<Rgb8>& crop, int requested) {
  constexpr int min_coarse_px = 10;
  int levels = requested;
  while (levels > 0 && (std::min(crop.width(), crop.height()) >> levels) < min_coarse_px) --levels;
  return levels;
}

}  // namespace

int reach_at(const LearnParameters& parameters, int level) {
  return level == 0 ? parameters.reach_px : parameters.coarse_reach;
}

std::vector<CliqueType> candidate_types(int level, int reach) {
  std::vector<CliqueType> types;
  for (int head = 0; head < 3; ++head)
    for (int tail = head; tail < 3; ++tail) types.push_back({level, 0, 0, head, tail});
  for (int dy = 0; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      if ((dy == 0 && dx <= 0) || dx * dx + dy * dy > reach * reach) continue;
      for (int head = 0; head < 3; ++head)
        for (int tail = 0; tail < 3; ++tail) types.push_back({level, dx, dy, head, tail});
    }
  return types;
}

CliqueModel begin_model(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states, int levels) {
  check_crop(crop, states);
  CliqueModel model;
  model.levels = levels_for(crop, levels);
  model.bands = find_bands(crop, states);
  model.crop_hash = hash_of(crop);
  model.crop_width = crop.width();
  model.crop_height = crop.height();
  return model;
}

LearnedTexture learn_texture(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                             const LearnParameters& parameters, Progress& progress) {
  LearnedTexture out;
  CliqueModel& model = out.model;
  model = begin_model(crop, states, parameters.levels);
  const BandPyramid example = make_pyramid(to_bands(crop, model.bands, states), model.levels);

  // The texture made to find what is missing: of the crop's size, or of the area of its counted
  // pixels.
  int width = crop.width();
  int height = crop.height();
  if (!states.empty()) {
    const auto counted = std::count_if(states.begin(), states.end(),
                                       [](std::uint8_t s) { return (s & pixel_counts) != 0; });
    width = height = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(counted))), 64, 256);
  }
  TextureTrial trial(model, width, height, learning_seed);
  progress.begin("learning a texture", parameters.types);
  for (int level = model.levels; level >= 0; --level) {
    std::vector<CliqueCandidate> candidates =
        make_candidates(example[static_cast<std::size_t>(level)], model.bands,
                        candidate_types(level, reach_at(parameters, level)));
    // Coarser levels together get at most half of the budget, the finest gets the rest.
    const auto budget = static_cast<std::size_t>(
        level > 0 ? parameters.types * (model.levels - level + 1) / (2 * (model.levels + 1))
                  : parameters.types);
    const auto add = [&](CliqueCandidate& c) {
      c.in = true;
      model.cliques.push_back(c.clique);
      progress.advance(1.0);
    };
    for (CliqueCandidate& c : candidates)
      if (always_in(c.clique.type)) add(c);
    trial.begin_level(model, level);
    for (int round = 0;; ++round) {
      trial.run(model, level, round == 0 ? 2 * parameters.rounds : parameters.rounds);
      LearningRound found = evaluate_candidates(candidates, trial.picture(level), model.bands);
      if (found.worst == candidates.size() || found.told.worst_l2 < parameters.enough ||
          model.cliques.size() >= budget) {
        found.told.level = level;
        out.levels.push_back(found.told);
        break;
      }
      add(candidates[found.worst]);
    }
  }
  return out;
}

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
