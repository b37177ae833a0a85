#include "texture/synthesis/synthesize.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/parallel.h"
#include "texture/synthesis/synth_level.h"
#include "texture/synthesis/synth_plane.h"

namespace belvedere {

namespace {

constexpr std::size_t most_guides = 32;
constexpr int least_side = 16;           // of the coarsest level, pixels
constexpr double jump_per_level = 0.04;  // relative depth between neighbours beyond which they are two surfaces

void check_parameters(const SynthesisParameters& parameters) {
  const auto in_range = [](const char* what, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      throw Error(ErrorKind::usage, fmt::format("synthesis {}", what), fmt::format("{}", value), fmt::format("{} … {}", low, high));
    }
  };
  in_range("levels", parameters.levels, 1, 8);
  in_range("reuse", parameters.reuse, 0, 10);
  in_range("copy_cap", parameters.copy_cap, 16, 100000);
  in_range("surroundings", parameters.surroundings, 0, 100);
  for (const auto& [pair, value] : parameters.unlikeness)
    in_range(fmt::format("unlikeness of classes {} and {}", pair.first, pair.second).c_str(), value, 0, 1);
  if (parameters.tile < 0 || parameters.tile % 2 != 0)
    throw Error(ErrorKind::usage, "synthesis tile", fmt::format("{}", parameters.tile), "0 or an even number of pixels");
  for (const auto& [name, weight] : parameters.weights) in_range(fmt::format("weight of \"{}\"", name).c_str(), weight, 0, 100);
}

// A guide that exemplars and target share, with its weight.
struct PairedGuide {
  std::vector<const Grid<std::uint8_t>*> of_exemplars;
  const Grid<std::uint8_t>* of_target = nullptr;
  synth::GuideRole role;
};

std::vector<PairedGuide> pair_guides(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                                     const SynthesisParameters& parameters, Progress& progress) {
  const auto weight_of = [&](const std::string& name) {
    double weight = 1.0;
    for (const auto& [guide, value] : parameters.weights) {
      if (guide == name) weight = value;
    }
    return weight;
  };
  std::vector<PairedGuide> paired;
  std::set<std::string> noted;
  const auto note = [&](const std::string& name, const char* lacking) {
    if (weight_of(name) > 0 && noted.insert(name).second)
      progress.note(fmt::format("guide \"{}\" is not used: {} lacks it", name, lacking));
  };
  for (const Guide& guide : target.guides) {
    PairedGuide pair;
    pair.of_target = &guide.values;
    pair.role.weight_q4 = std::llround(16.0 * static_cast<double>(synth::price::guide) * weight_of(guide.name));
    for (const Exemplar& exemplar : exemplars) {
      if (const Grid<std::uint8_t>* values = exemplar.guides.find(guide.name)) pair.of_exemplars.push_back(values);
    }
    if (pair.of_exemplars.size() != exemplars.size()) {
      note(guide.name, exemplars.size() == 1 ? "the exemplar" : "an exemplar");
    } else if (pair.role.weight_q4 > 0) {
      paired.push_back(std::move(pair));
    }
  }
  for (const Exemplar& exemplar : exemplars) {
    for (const Guide& guide : exemplar.guides.guides) {
      if (target.find(guide.name) == nullptr) note(guide.name, "the target");
    }
  }
  for (const auto& [name, weight] : parameters.weights) {
    bool known = target.find(name) != nullptr;
    for (const Exemplar& exemplar : exemplars) known = known || exemplar.guides.find(name) != nullptr;
    if (!known) note(name, "every picture");
  }
  if (paired.size() > most_guides) {
    throw Error(ErrorKind::limit, "synthesis", fmt::format("{} guides", paired.size()),
                fmt::format("at most {} guides of a weight above 0", most_guides));
  }
  // The strongest first: the first two order the lists of picks.
  std::stable_sort(paired.begin(), paired.end(),
                   [](const PairedGuide& a, const PairedGuide& b) { return a.role.weight_q4 > b.role.weight_q4; });
  return paired;
}

// Dense numbers for the labels that exemplars have, and which of them each label of the target copies from.
struct Classes {
  std::array<std::uint32_t, 256> of_exemplar{};
  std::array<std::uint32_t, 256> of_target{};
  int count = 0;
};

Classes number_classes(const std::vector<Exemplar>& exemplars, const GuideStack& target, const SynthesisParameters& parameters,
                       Progress& progress) {
  std::array<bool, 256> offered{};
  std::array<std::size_t, 256> requested{};
  for (const Exemplar& exemplar : exemplars) {
    for (const std::uint8_t label : exemplar.guides.label) offered[label] = true;
  }
  for (const std::uint8_t label : target.label) ++requested[label];
  Classes classes;
  classes.of_exemplar.fill(synth::no_class);
  classes.of_target.fill(synth::no_class);
  for (std::size_t label = 0; label < unused_label; ++label) {
    if (offered[label]) classes.of_exemplar[label] = static_cast<std::uint32_t>(classes.count++);
  }
  for (std::size_t label = 0; label < unused_label; ++label) {
    classes.of_target[label] = classes.of_exemplar[label];
    if (requested[label] == 0 || offered[label]) continue;
    const auto fallback = parameters.fallback.find(static_cast<std::uint8_t>(label));
    if (fallback != parameters.fallback.end() && classes.of_exemplar[fallback->second] != synth::no_class) {
      classes.of_target[label] = classes.of_exemplar[fallback->second];
      progress.note(
          fmt::format("class {} has no texels in any exemplar: {} pixels copy from class {}", label, requested[label], fallback->second));
    } else {
      progress.note(
          fmt::format("class {} has no texels in any exemplar and no fallback: {} pixels stay without texture", label, requested[label]));
    }
  }
  return classes;
}

synth::SurroundingsPrice surroundings_price(const Classes& classes, const SynthesisParameters& parameters) {
  const std::size_t count = static_cast<std::size_t>(classes.count);
  std::vector<std::uint8_t> pairs(count * count, 16);
  for (const auto& [labels, value] : parameters.unlikeness) {
    const std::uint32_t a = classes.of_target[labels.first];
    const std::uint32_t b = classes.of_target[labels.second];
    if (a == synth::no_class || b == synth::no_class) continue;
    pairs[a * count + b] = pairs[b * count + a] = static_cast<std::uint8_t>(std::lround(16.0 * value));
  }
  return {std::llround(static_cast<double>(synth::price::surroundings_q8) * parameters.surroundings), std::move(pairs), classes.count};
}

synth::Plane exemplar_plane(const std::vector<Exemplar>& exemplars, const std::vector<PairedGuide>& guides, const Classes& classes) {
  std::vector<std::pair<int, int>> sizes;
  sizes.reserve(exemplars.size());
  for (const Exemplar& exemplar : exemplars) sizes.emplace_back(exemplar.picture.width(), exemplar.picture.height());
  synth::Plane plane = synth::make_plane(sizes, static_cast<int>(guides.size()));
  for (std::size_t e = 0; e < exemplars.size(); ++e) {
    const Exemplar& exemplar = exemplars[e];
    parallel_rows(exemplar.picture.height(), [&](int y) {
      for (int x = 0; x < exemplar.picture.width(); ++x) {
        const std::uint32_t at = plane.index(static_cast<int>(e), x, y);
        const Rgb8 colour = exemplar.picture(x, y);
        plane.words[at] = colour[0] | static_cast<std::uint32_t>(colour[1]) << 8 | static_cast<std::uint32_t>(colour[2]) << 16 |
                          classes.of_exemplar[exemplar.guides.label(x, y)] << 24;
        for (std::size_t g = 0; g < guides.size(); ++g) plane.guides[at * guides.size() + g] = (*guides[g].of_exemplars[e])(x, y);
      }
    });
  }
  synth::pad(plane);
  return plane;
}

synth::Plane target_plane(const GuideStack& target, const std::vector<PairedGuide>& guides, const Classes& classes) {
  synth::Plane plane = synth::make_plane({{target.width(), target.height()}}, static_cast<int>(guides.size()));
  parallel_rows(target.height(), [&](int y) {
    for (int x = 0; x < target.width(); ++x) {
      const std::uint32_t at = plane.index(0, x, y);
      plane.words[at] = classes.of_target[target.label(x, y)] << 24;
      for (std::size_t g = 0; g < guides.size(); ++g) plane.guides[at * guides.size() + g] = (*guides[g].of_target)(x, y);
    }
  });
  synth::pad(plane);
  return plane;
}

int level_count(const std::vector<Exemplar>& exemplars, const GuideStack& target, int requested) {
  int side = std::min(target.width(), target.height());
  for (const Exemplar& exemplar : exemplars) side = std::min({side, exemplar.picture.width(), exemplar.picture.height()});
  int levels = 1;
  while (levels < requested && (side >> levels) >= least_side) ++levels;
  return levels;
}

// The result takes the place of what led to it: it is the largest moment of the memory.
MatchField to_match_field(const std::vector<std::uint32_t>& matches, const synth::Plane::Part& part, std::size_t stride,
                          const synth::Plane& exemplars) {
  MatchField field(part.width, part.height);
  parallel_rows(part.height, [&](int y) {
    for (int x = 0; x < part.width; ++x) {
      const std::uint32_t texel = matches[part.origin + static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
      if (texel == exemplars.nowhere()) continue;
      const synth::Plane::Place place = exemplars.place(texel);
      field(x, y) = {static_cast<std::uint16_t>(place.part), static_cast<std::uint16_t>(place.x), static_cast<std::uint16_t>(place.y)};
    }
  });
  return field;
}

}  // namespace

MatchField synthesize(const std::vector<Exemplar>& exemplars, const GuideStack& target, const SynthesisParameters& parameters,
                      Progress& progress) {
  if (exemplars.empty()) throw Error(ErrorKind::usage, "synthesis", "no exemplar", "at least one");
  if (exemplars.size() >= Match::none) {
    throw Error(ErrorKind::limit, "synthesis", fmt::format("{} exemplars", exemplars.size()), "at most 65534");
  }
  for (const Exemplar& exemplar : exemplars) check_exemplar(exemplar);
  check_guide_stack(target, "target");
  check_parameters(parameters);

  const std::vector<PairedGuide> guides = pair_guides(exemplars, target, parameters, progress);
  const Classes classes = number_classes(exemplars, target, parameters, progress);
  if (classes.count == 0) return MatchField(target.width(), target.height());
  std::vector<synth::GuideRole> roles;
  roles.reserve(guides.size());
  for (const PairedGuide& guide : guides) roles.push_back(guide.role);

  const int levels = level_count(exemplars, target, parameters.levels);
  std::vector<synth::Plane> sources{exemplar_plane(exemplars, guides, classes)};
  std::vector<synth::Plane> targets{target_plane(target, guides, classes)};
  std::vector<Grid<float>> depths;  // of the coarser levels, from 1 on
  for (int level = 1; level < levels; ++level) {
    sources.push_back(synth::halve(sources.back()));
    targets.push_back(synth::halve(targets.back()));
    if (!target.depth_m.empty()) {
      const std::size_t finer = static_cast<std::size_t>(level) - 1;
      depths.push_back(synth::halve_depth(level == 1 ? target.depth_m : depths.back(), targets[finer], targets.back()));
    }
  }

  const synth::SurroundingsPrice around = surroundings_price(classes, parameters);
  std::vector<std::uint32_t> matches;  // of the level done last
  for (int level = levels - 1; level >= 0; --level) {
    const std::size_t l = static_cast<std::size_t>(level);
    // Pixels of a coarse level lie further apart, so their depths may differ by more on one and the same surface.
    std::vector<std::uint8_t> links;
    if (!target.depth_m.empty()) {
      links = synth::make_links(level == 0 ? target.depth_m : depths.back(), targets[l],
                                static_cast<float>(1.0 + jump_per_level * (level + 1)));
      if (level > 0) depths.pop_back();
    }
    synth::LevelSettings settings = synth::settings_for_level(level, parameters.seed, parameters.copy_cap, parameters.reuse);
    settings.tile = parameters.tile;
    // Guides that do not order the lists are served by drawing several texels and keeping the one that fits them best.
    const synth::ListKeys keys = synth::choose_list_keys(roles);
    settings.draws = roles.size() > (keys.bucketed ? 2U : 1U) ? 4 : 1;
    synth::LevelState state(settings, roles, classes.count, sources[l], targets[l], std::move(links), around);
    progress.begin(fmt::format("synthesize, level {} of {}", levels - level, levels), settings.passes + settings.replacing_passes);
    if (level == levels - 1) {
      synth::start_from_picks(state);
    } else {
      synth::start_from_coarser(state, sources[l + 1], targets[l + 1], matches);
      sources.resize(l + 1);  // done with the coarser pictures
      targets.resize(l + 1);
    }
    matches = {};
    synth::improve(state, progress);
    matches = std::move(state.match);
  }
  const synth::Plane::Part part = targets[0].parts[0];
  const std::size_t stride = static_cast<std::size_t>(targets[0].stride);
  targets.clear();
  return to_match_field(matches, part, stride, sources[0]);
}

std::size_t synthesis_bytes(std::size_t texels, std::size_t pixels, int guides, bool with_depth) {
  // Per texel: word and guides with a third more of the coarser levels, its record and its list entry (synth_texels.h, synth_lists.h),
  // and what these are made from: bin and contrast or surroundings.
  // Per pixel at the start of the finest level: word and guides, match, every fourth's next, pieces, surroundings, silhouettes, and a
  // quarter of what the level above holds of words, guides and matches; later, instead, what pieces moved as a whole take. The result
  // (6) comes when all but the matches is gone.
  const std::size_t g = static_cast<std::size_t>(guides);
  const std::size_t record = g <= 1 ? 8 : 8 + (g + 6) / 8 * 8;
  const std::size_t entry = 4 + (10 + g + 3) / 4 * 4;
  const std::size_t per_texel = (4 + g) * 4 / 3 + 1 + record + entry + 5;
  const std::size_t per_pixel = 4 + g + 4 + 1 + 6 + 2 + (8 + g) / 4 + 3 + (with_depth ? 2 : 0);
  return texels * per_texel + pixels * per_pixel + (std::size_t{32} << 20);
}

}  // namespace belvedere
