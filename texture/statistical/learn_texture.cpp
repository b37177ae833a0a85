#include "texture/statistical/learn_texture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "base/cache/content_hash.h"
#include "base/error.h"
#include "texture/statistical/clique_flow.h"
#include "texture/statistical/learning_round.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {
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

}  // namespace belvedere
