#include "texture/synthesis/synth_setup.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "base/error.h"
#include "base/random.h"
#include "texture/synthesis/synth_kernel.h"
#include "texture/synthesis/synth_level.h"

// Candidates for a pixel: picks from the lists, and those that silhouettes forbid.

namespace belvedere::synth {
namespace {

constexpr std::size_t max_guides = 32;
constexpr int min_side = 16;  // of the coarsest level, pixels
constexpr double jump_per_level =
    0.04;  // relative depth difference between neighbours beyond which they are two surfaces

void check_parameters(const SynthesisParameters& parameters) {
  const auto in_range = [](const char* what, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      throw Error(ErrorKind::usage, fmt::format("synthesis {}", what), fmt::format("{}", value),
                  fmt::format("{} … {}", low, high));
    }
  };
  in_range("levels", parameters.levels, 1, 8);
  in_range("reuse", parameters.reuse, 0, 10);
  in_range("copy_cap", parameters.copy_cap, 16, 100000);
  in_range("surroundings", parameters.surroundings, 0, max_weight);
  if (parameters.neighbourhood % 2 == 0 || parameters.neighbourhood < 3 ||
      parameters.neighbourhood > 2 * largest_patch_radius + 1)
    throw Error(ErrorKind::usage, "synthesis neighbourhood",
                fmt::format("{}", parameters.neighbourhood), "3, 5, 7, 9 or 11 pixels");
  if (parameters.distance != "ssd" && parameters.distance != "normalized")
    throw Error(ErrorKind::usage, "synthesis distance", parameters.distance, "ssd or normalized");
  if (parameters.surroundings_of != "commonest" && parameters.surroundings_of != "all")
    throw Error(ErrorKind::usage, "synthesis surroundings_of", parameters.surroundings_of,
                "commonest or all");
  for (const auto& [pair, value] : parameters.class_dissimilarity)
    in_range(fmt::format("dissimilarity of classes {} and {}", pair.first, pair.second).c_str(),
             value, 0, 1);
  if (parameters.tile < 0 || parameters.tile % 2 != 0)
    throw Error(ErrorKind::usage, "synthesis tile", fmt::format("{}", parameters.tile),
                "0 or an even number of pixels");
  for (const auto& [name, weight] : parameters.weights)
    in_range(fmt::format("weight of \"{}\"", name).c_str(), weight, 0, max_weight);
}

// A guide that exemplars and target share, with its weight.
struct PairedGuide {
  std::string name;
  GuideRole role;
};

std::vector<PairedGuide> pair_guides(const std::vector<Exemplar>& exemplars,
                                     const GuideStack& target,
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
    pair.name = guide.name;
    pair.role.weight_q4 =
        std::llround(16.0 * static_cast<double>(price::guide) * weight_of(guide.name));
    const auto knowing = std::count_if(
        exemplars.begin(), exemplars.end(),
        [&](const Exemplar& exemplar) { return exemplar.guides.find(guide.name) != nullptr; });
    if (knowing == 0) {
      note(guide.name, exemplars.size() == 1 ? "the exemplar" : "every exemplar");
      continue;
    }
    if (pair.role.weight_q4 == 0) continue;
    if (static_cast<std::size_t>(knowing) < exemplars.size())
      progress.note(fmt::format(
          "guide \"{}\": {} of {} exemplars lack it and are chosen without it", guide.name,
          exemplars.size() - static_cast<std::size_t>(knowing), exemplars.size()));
    paired.push_back(std::move(pair));
  }
  for (const Exemplar& exemplar : exemplars) {
    for (const Guide& guide : exemplar.guides.guides) {
      if (target.find(guide.name) == nullptr) note(guide.name, "the target");
    }
  }
  for (const auto& [name, weight] : parameters.weights) {
    bool known = target.find(name) != nullptr;
    for (const Exemplar& exemplar : exemplars)
      known = known || exemplar.guides.find(name) != nullptr;
    if (!known) note(name, "every picture");
  }
  if (paired.size() > max_guides) {
    throw Error(ErrorKind::limit, "synthesis", fmt::format("{} guides", paired.size()),
                fmt::format("at most {} guides with a weight above 0", max_guides));
  }
  // In descending order of weight: the first two order the lists of picks.
  std::stable_sort(paired.begin(), paired.end(), [](const PairedGuide& a, const PairedGuide& b) {
    return a.role.weight_q4 > b.role.weight_q4;
  });
  return paired;
}

Classes number_classes(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                       const SynthesisParameters& parameters, std::size_t pixels_each,
                       Progress& progress) {
  std::array<bool, 256> offered{};
  std::array<std::size_t, 256> requested{};
  for (const Exemplar& exemplar : exemplars) {
    for (const std::uint8_t label : exemplar.guides.label) offered[label] = true;
  }
  for (const std::uint8_t label : target.label) requested[label] += pixels_each;
  Classes classes;
  classes.of_exemplar.fill(no_class);
  classes.of_target.fill(no_class);
  classes.around.fill(no_class);
  for (std::size_t label = 0; label < unused_label; ++label) {
    if (offered[label]) classes.of_exemplar[label] = static_cast<std::uint32_t>(classes.count++);
  }
  for (std::size_t label = 0; label < unused_label; ++label) {
    classes.of_target[label] = classes.around[label] = classes.of_exemplar[label];
    if (offered[label]) continue;
    const auto fallback = parameters.fallback.find(static_cast<std::uint8_t>(label));
    const bool stood_in =
        fallback != parameters.fallback.end() && classes.of_exemplar[fallback->second] != no_class;
    if (stood_in) classes.of_target[label] = classes.of_exemplar[fallback->second];
    if (requested[label] == 0) continue;
    classes.around[label] = classes.of_target[label];
    if (stood_in) {
      progress.note(
          fmt::format("class {} has no texels in any exemplar: {} pixels copy from class {}", label,
                      requested[label], fallback->second));
    } else {
      progress.note(fmt::format(
          "class {} has no texels in any exemplar and no fallback: {} pixels stay without texture",
          label, requested[label]));
    }
  }
  return classes;
}

SurroundingsPrice surroundings_price(const Classes& classes,
                                     const SynthesisParameters& parameters) {
  const std::size_t count = static_cast<std::size_t>(classes.count);
  std::vector<std::uint8_t> pairs(count * count, 16);
  for (const auto& [labels, value] : parameters.class_dissimilarity) {
    const std::uint32_t a = classes.around[labels.first];
    const std::uint32_t b = classes.around[labels.second];
    if (a == no_class || b == no_class) continue;
    pairs[a * count + b] = pairs[b * count + a] =
        static_cast<std::uint8_t>(std::lround(16.0 * value));
  }
  return {std::llround(static_cast<double>(price::surroundings_q8) * parameters.surroundings),
          std::move(pairs), classes.count};
}

}  // namespace

Setup make_setup(const std::vector<Exemplar>& exemplars, const GuideStack& target,
                 const SynthesisParameters& parameters, std::size_t pixels_each,
                 Progress& progress) {
  if (exemplars.empty()) throw Error(ErrorKind::usage, "synthesis", "no exemplar", "at least one");
  if (exemplars.size() >= Match::none) {
    throw Error(ErrorKind::limit, "synthesis", fmt::format("{} exemplars", exemplars.size()),
                "at most 65534");
  }
  for (const Exemplar& exemplar : exemplars) check_exemplar(exemplar);
  check_guide_stack(target, "target");
  check_parameters(parameters);
  Setup setup;
  setup.parameters = parameters;
  for (PairedGuide& pair : pair_guides(exemplars, target, parameters, progress)) {
    setup.guide_names.push_back(std::move(pair.name));
    setup.roles.push_back(pair.role);
  }
  setup.classes = number_classes(exemplars, target, parameters, pixels_each, progress);
  setup.around_price = surroundings_price(setup.classes, parameters);
  return setup;
}

LevelSettings Setup::settings(int level) const {
  LevelSettings settings =
      settings_for_level(level, parameters.seed, parameters.copy_cap, parameters.reuse);
  settings.tile = parameters.tile;
  settings.patch_radius = parameters.patch_radius();
  settings.normalized = parameters.distance == "normalized";
  settings.all_surroundings = parameters.surroundings_of == "all";
  // Guides that do not order the lists are met by drawing several texels and keeping the best one.
  const ListKeys keys = choose_list_keys(roles);
  settings.draws = roles.size() > (keys.bucketed ? 2U : 1U) ? 4 : 1;
  return settings;
}

int level_count(const std::vector<Exemplar>& exemplars, int width, int height, int requested) {
  int side = std::min(width, height);
  for (const Exemplar& exemplar : exemplars)
    side = std::min({side, exemplar.picture.width(), exemplar.picture.height()});
  int levels = 1;
  while (levels < requested && (side >> levels) >= min_side) ++levels;
  return levels;
}

float depth_ratio(int level) { return static_cast<float>(1.0 + jump_per_level * (level + 1)); }

namespace {

// No texel may be used too often; where too few meet the request, some pixels take others.
void note_widened(const Setup& setup, const LevelState& state, Progress& progress) {
  if (state.widened.empty() || setup.guide_names.empty()) return;
  int farthest = 0;
  for (const std::uint32_t pixel : state.widened)
    farthest = std::max(farthest, std::abs(state.target.guides_at(pixel)[0] -
                                           state.texels.at(state.match[pixel]).guides()[0]));
  progress.note(
      fmt::format("too few texels for the guide {}: to avoid overuse, {} pixels "
                  "copy others, with errors of up to {} of 255",
                  setup.guide_names[0], state.widened.size(), farthest));
}

}  // namespace

std::vector<std::uint32_t> synthesize_levels(const Setup& setup, const GuideStack& target,
                                             int finest, int levels, std::vector<Plane>& sources,
                                             std::vector<Plane>& targets, Progress& progress) {
  std::vector<Grid<float>> depths;  // of the coarser levels
  for (int level = finest + 1; level < levels; ++level) {
    targets.push_back(halve(targets.back()));
    if (!target.depth_m.empty()) {
      const std::size_t finer = targets.size() - 2;
      depths.push_back(halve_depth(depths.empty() ? target.depth_m : depths.back(), targets[finer],
                                   targets.back()));
    }
  }
  std::vector<std::uint32_t> matches;  // of the last finished level
  for (int level = levels - 1; level >= finest; --level) {
    const std::size_t l = static_cast<std::size_t>(level);
    const std::size_t t = static_cast<std::size_t>(level - finest);
    // Pixels of a coarse level are farther apart, so their depths may differ more on one surface.
    std::vector<std::uint8_t> links;
    if (!target.depth_m.empty()) {
      links = make_links(level == finest ? target.depth_m : depths.back(), targets[t],
                         depth_ratio(level), setup.parameters.patch_radius());
      if (level > finest) depths.pop_back();
    }
    const LevelSettings settings = setup.settings(level);
    LevelState state(settings, setup.roles, setup.classes.count, sources[l], targets[t],
                     std::move(links), setup.around_price);
    progress.begin(fmt::format("synthesize, level {} of {}", levels - level, levels),
                   settings.passes + settings.replacing_passes);
    if (level == levels - 1) {
      start_from_picks(state);
    } else {
      start_from_coarser(state, sources[l + 1], targets[t + 1], matches);
      sources.resize(l + 1);  // the coarser pictures are no longer needed
      targets.resize(t + 1);
    }
    matches = {};
    improve(state, progress);
    if (finest == 0 && level == 0) note_widened(setup, state, progress);
    matches = std::move(state.match);
  }
  return matches;
}

Slack make_slack(const KernelView& view, std::uint32_t pixel) {
  const std::uint32_t label_class = class_of(view.target->words[pixel]);
  const PickWindow window = view.lists->window(label_class, view.target->guides_at(pixel));
  const std::size_t first =
      static_cast<std::size_t>(label_class) * static_cast<std::size_t>(view.exemplars->guide_count);
  return {std::max(0, window.slack - 1), window.buckets * ListKeys::bucket_width,
          view.usual_error == nullptr ? nullptr : view.usual_error + first};
}

Forbidden forbidden_texels(const KernelView& view, std::uint32_t pixel, bool all_neighbours) {
  static constexpr std::array<std::array<int, 2>, 4> steps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  Forbidden forbidden;
  for (const auto& [dx, dy] : steps) {
    // Outside the picture's sides is `nowhere`, whose neighbours have no class either.
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(pixel) + dx +
                              static_cast<std::ptrdiff_t>(dy) * view.target->stride;
    if (!all_neighbours &&
        (view.links == nullptr || linked(view.links, view.target->stride, pixel, dx, dy)) &&
        continues(view, view.match[at], dx, dy))
      continue;
    const std::ptrdiff_t texel = static_cast<std::ptrdiff_t>(view.match[at]) - dx -
                                 static_cast<std::ptrdiff_t>(dy) * view.exemplars->stride;
    forbidden.texels[static_cast<std::size_t>(forbidden.count++)] =
        static_cast<std::uint32_t>(texel);
  }
  return forbidden;
}

std::uint32_t allowed_texel(const KernelView& view, std::uint32_t pixel, const Forbidden& forbidden,
                            std::uint64_t key, int x, int y) {
  constexpr int tries = 16;
  const Slack slack = make_slack(view, pixel);
  for (int i = 1; i <= tries; ++i) {
    const std::uint32_t texel =
        draw_texel(view, pixel, key + static_cast<std::uint64_t>(i), x, y, slack);
    if (!forbidden.has(texel)) return texel;
  }
  const std::uint32_t label_class = class_of(view.target->words[pixel]);
  for (std::int64_t i = 0; i < view.lists->texel_count(label_class); ++i) {
    const std::uint32_t texel = view.lists->texel(label_class, i);
    if (!forbidden.has(texel)) return texel;
  }
  return view.match[pixel];
}

PickRun begin_draw(const KernelView& view, std::uint32_t pixel, std::uint64_t key, int x, int y,
                   int widen) {
  const std::uint32_t random = static_cast<std::uint32_t>(random_bits(key, x, y) >> 32);
  return view.lists->pick(class_of(view.target->words[pixel]), view.target->guides_at(pixel),
                          random, widen);
}

namespace {

// The cheapest of the first `draws` entries of a run, by guides, surroundings and the extra cost
// `further`.
template <class F>
std::uint32_t cheapest_entry(const KernelView& view, std::uint32_t pixel, const PickRun& run,
                             int draws, Slack slack, F&& further) {
  const std::uint8_t* requested = view.target->guides_at(pixel);
  const Surroundings requested_around =
      view.around_price == nullptr ? Surroundings() : view.target_around[pixel];
  const std::uint32_t own = class_of(view.target->words[pixel]);
  slack.others = nullptr;  // picks are as good as possible
  std::uint32_t best = view.exemplars->nowhere();
  std::int64_t best_cost = INT64_MAX;
  for (std::uint32_t i = 0; i < std::min(run.count, static_cast<std::uint32_t>(draws)); ++i) {
    const PickLists::Entry entry = view.lists->entry(run.entry(i));
    const std::int64_t cost = guide_cost(view, requested, entry.guides(), slack,
                                         lacking_of(*view.exemplars, entry.texel(), own)) +
                              surroundings_cost(view, requested_around, entry.around()) +
                              further(entry);
    if (cost < best_cost) {
      best_cost = cost;
      best = entry.texel();
    }
  }
  return best;
}

int draws_at(const KernelView& view, std::uint32_t pixel) {
  if (view.around_price == nullptr) return view.draws;
  const Surroundings around = view.target_around[pixel];
  const std::uint32_t own = class_of(view.target->words[pixel]);
  const int others =
      view.target_shares == nullptr ? around.others : 255 - view.target_shares->of(around)[own];
  return others > border_others ? std::max(view.draws, view.border_draws) : view.draws;
}

}  // namespace

std::uint32_t finish_draw(const KernelView& view, std::uint32_t pixel, const PickRun& run,
                          Slack slack) {
  if (run.count == 0) return view.exemplars->nowhere();
  const int draws = draws_at(view, pixel);
  if (draws == 1) return view.lists->entry(run.entry(0)).texel();
  return cheapest_entry(view, pixel, run, draws, slack,
                        [](const PickLists::Entry&) { return std::int64_t{0}; });
}

std::uint32_t finish_fitting_draw(const KernelView& view, std::uint32_t pixel, const PickRun& run,
                                  Slack slack) {
  if (view.fitting_draws == 1 || (view.links != nullptr && (view.links[pixel] & link::cut_patch))) {
    return finish_draw(view, pixel, run, slack);
  }
  const Greys greys = greys_around(*view.target, pixel);
  const int draws = std::max(view.fitting_draws, draws_at(view, pixel));
  return cheapest_entry(view, pixel, run, draws, slack, [&](const PickLists::Entry& entry) {
    return price::grey * grey_distance(greys, entry.greys());
  });
}

std::uint32_t draw_texel(const KernelView& view, std::uint32_t pixel, std::uint64_t key, int x,
                         int y, Slack slack) {
  return finish_draw(view, pixel, begin_draw(view, pixel, key, x, y), slack);
}

SurfaceRows surface_around(const KernelView& view, std::uint32_t pixel) {
  constexpr int max = 2 * largest_patch_radius + 1;
  const int side = 2 * view.radius + 1;
  SurfaceRows rows{};
  std::array<std::uint8_t, static_cast<std::size_t>(max) * max>
      open{};  // positions reached, y × side + x; each enters once
  std::size_t count = 0;
  const auto reach = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= side || y >= side) return;
    std::uint16_t& row = rows[static_cast<std::size_t>(y)];
    if (row >> x & 1) return;
    row = static_cast<std::uint16_t>(row | 1U << x);
    open[count++] = static_cast<std::uint8_t>(y * side + x);
  };
  reach(view.radius, view.radius);
  for (std::size_t i = 0; i < count; ++i) {
    const int x = open[i] % side;
    const int y = open[i] / side;
    const std::uint8_t bits =
        view.links[static_cast<std::ptrdiff_t>(pixel) + x - view.radius +
                   static_cast<std::ptrdiff_t>(y - view.radius) * view.target->stride];
    if (bits & link::right) reach(x + 1, y);
    if (bits & link::left) reach(x - 1, y);
    if (bits & link::down) reach(x, y + 1);
    if (bits & link::up) reach(x, y - 1);
  }
  return rows;
}

}  // namespace belvedere::synth
