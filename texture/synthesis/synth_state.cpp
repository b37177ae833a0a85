#include "texture/synthesis/synth_state.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

namespace belvedere::synth {
namespace {

// The guides' weights for 32-bit prices; empty if these could overflow, or if one or two guides are
// as fast one by one.
std::vector<std::uint32_t> vector_weights_of(const std::vector<GuideRole>& guides) {
  std::vector<std::uint32_t> weights(vector_guides, 0);
  std::int64_t largest_price = 0;
  for (const GuideRole& guide : guides) largest_price += guide.weight_q4 * 255 * 255;
  if (guides.size() <= 2 || guides.size() > weights.size() || largest_price > INT32_MAX) return {};
  for (std::size_t g = 0; g < guides.size(); ++g)
    weights[g] = static_cast<std::uint32_t>(guides[g].weight_q4);
  return weights;
}

}  // namespace

std::vector<std::uint8_t> usual_errors_of_picks(const LevelState& state) {
  const int classes = state.source->classes;
  constexpr int samples_across = 256;
  const std::size_t guides = static_cast<std::size_t>(state.exemplars.guide_count);
  const Plane::Part& part = state.target.parts[0];
  const KernelView view = state.view(0);
  const std::uint64_t key = key_for(state.settings, Purpose::errors);
  std::vector<std::int32_t> counts(static_cast<std::size_t>(classes) * guides * 256, 0);
  for (int y = 0; y < part.height; y += std::max(1, part.height / samples_across)) {
    for (int x = 0; x < part.width; x += std::max(1, part.width / samples_across)) {
      const std::uint32_t at = state.target.index(0, x, y);
      const std::uint32_t label_class = class_of(state.target.words[at]);
      if (label_class == no_class) continue;
      const std::uint8_t* requested = state.target.guides_at(at);
      const std::uint32_t texel = draw_texel(view, at, key, x, y, make_slack(view, at));
      const std::uint8_t* offered = state.texels.at(texel).guides();
      const int exemplar = state.exemplars.part_of(texel);
      for (std::size_t g = 0; g < guides; ++g) {
        if (!state.exemplars.knows(exemplar, g)) continue;
        ++counts[(label_class * guides + g) * 256 +
                 static_cast<std::size_t>(std::abs(requested[g] - offered[g]))];
      }
    }
  }
  std::vector<std::uint8_t> medians(static_cast<std::size_t>(classes) * guides, 0);
  for (std::size_t i = 0; i < medians.size(); ++i) {
    const auto first = counts.begin() + static_cast<std::ptrdiff_t>(i * 256);
    const std::int64_t total = std::accumulate(first, first + 256, std::int64_t{0});
    std::int64_t below = first[0];
    int error = 0;
    while (error < 255 && 2 * below < total) below += first[++error];
    medians[i] = static_cast<std::uint8_t>(error);
  }
  return medians;
}

LevelSettings settings_for_level(int level, std::uint64_t seed, int copy_cap, double reuse) {
  LevelSettings settings;
  settings.level = level;
  settings.seed = seed;
  settings.passes = level == 1 ? 5 : 4;
  settings.replacing_passes = level == 0 ? 2 : level == 1 ? 1 : 0;
  const int shift = 2 * level;  // a level has a quarter of the pixels
  settings.copy_cap = std::max<std::int64_t>(
      1, (static_cast<std::int64_t>(copy_cap) + (1LL << shift) / 2) >> shift);
  settings.reuse_price = std::llround(static_cast<double>(price::reuse) * reuse);
  settings.min_window = std::max(16, 64 >> shift);
  settings.surroundings_radius = std::max(2, 8 >> level);
  return settings;
}

namespace {

bool tells_shares(const LevelSettings& settings, const SurroundingsPrice& price) {
  return settings.all_surroundings && !price.is_free();
}

std::vector<Surroundings> offered_around(const LevelSettings& settings, const Plane& exemplars,
                                         int classes, const SurroundingsPrice& price,
                                         const ClassShares& shares) {
  if (price.is_free()) return {};
  return shares.empty() ? make_surroundings(exemplars, settings.surroundings_radius, classes)
                        : shares.numbers();
}

}  // namespace

LevelSource::LevelSource(const LevelSettings& settings, const std::vector<GuideRole>& guide_roles,
                         int class_count, const Plane& exemplar_plane, const TexelDemand& demand,
                         const SurroundingsPrice& surroundings_price)
    : LevelSource(settings, guide_roles, class_count, exemplar_plane, demand, surroundings_price,
                  tells_shares(settings, surroundings_price)
                      ? ClassShares(exemplar_plane, settings.surroundings_radius, class_count)
                      : ClassShares()) {}

LevelSource::LevelSource(const LevelSettings& settings, const std::vector<GuideRole>& guide_roles,
                         int class_count, const Plane& exemplar_plane, const TexelDemand& demand,
                         const SurroundingsPrice& surroundings_price, ClassShares class_shares)
    : LevelSource(
          settings, guide_roles, class_count, exemplar_plane, demand, surroundings_price,
          class_shares,
          offered_around(settings, exemplar_plane, class_count, surroundings_price, class_shares)) {
}

LevelSource::LevelSource(const LevelSettings& settings, const std::vector<GuideRole>& guide_roles,
                         int class_count, const Plane& exemplar_plane, const TexelDemand& demand,
                         const SurroundingsPrice& surroundings_price, ClassShares class_shares,
                         const std::vector<Surroundings>& around)
    : exemplars(exemplar_plane),
      has_cuts(!exemplar_plane.cuts.empty()),
      classes(class_count),
      guides(guide_roles),
      vector_weights(vector_weights_of(guide_roles)),
      around_price(surroundings_price),
      shares(std::move(class_shares)),
      texels(exemplars, make_bins(exemplars, class_count), around),
      lists(exemplars, demand, class_count, guides, settings.min_window, around) {
  shares.forget_numbers();  // contained in records and lists
}

LevelState::LevelState(const LevelSettings& level_settings, const std::vector<GuideRole>& guides,
                       int classes, const Plane& exemplar_plane, Plane& target_plane,
                       std::vector<std::uint8_t> surface_links,
                       const SurroundingsPrice& around_price)
    : LevelState(level_settings,
                 std::make_shared<LevelSource>(level_settings, guides, classes, exemplar_plane,
                                               count_texel_demand(target_plane, classes, guides),
                                               around_price),
                 target_plane, std::move(surface_links)) {
  source->usual_error = usual_errors_of_picks(*this);
}

LevelState::LevelState(const LevelSettings& level_settings,
                       std::shared_ptr<LevelSource> level_source, Plane& target_plane,
                       std::vector<std::uint8_t> surface_links)
    : settings(level_settings),
      source(std::move(level_source)),
      exemplars(source->exemplars),
      texels(source->texels),
      lists(source->lists),
      target(target_plane),
      links(std::move(surface_links)),
      match(target.words.size(), exemplars.nowhere()),
      bins_expected(static_cast<std::size_t>(source->classes) * bins_per_class, 0),
      bins_actual(bins_expected),
      bin_cost(bins_expected),
      bin_cost_kept(bins_expected),
      reuse_q4(static_cast<std::size_t>(source->classes), 0),
      max_uses(static_cast<std::size_t>(source->classes), 0xffffffffU),
      pieces(target) {
  const Plane::Part& part = target.parts[0];
  next.resize(static_cast<std::size_t>((part.width + 1) / 2) *
              static_cast<std::size_t>((part.height + 1) / 2));
  std::vector<std::int64_t> pixel_counts(static_cast<std::size_t>(source->classes), 0);
  target.for_each([&](std::uint32_t at) {
    const std::uint32_t c = class_of(target.words[at]);
    if (c == no_class) return;
    ++pixel_counts[c];
    if (!lists.has_class(c)) target.words[at] |= no_class << 24;
  });
  for (std::size_t c = 0; c < pixel_counts.size(); ++c) {
    // Price / max(1/4, pixels per texel of the class): reuse is expensive where it can be avoided.
    const std::int64_t texels_of_class = lists.texel_count(static_cast<std::uint32_t>(c));
    const std::int64_t pixels = pixel_counts[c];
    const std::int64_t full = settings.reuse_price * 16;
    reuse_q4[c] = 4 * pixels <= texels_of_class ? 4 * full : full * texels_of_class / pixels;
    // If reuse is priced at all, no texel may serve more than 6 + 3 × pixels per texel.
    if (settings.reuse_price > 0 && texels_of_class > 0)
      max_uses[c] = static_cast<std::uint32_t>(6 + 3 * pixels / texels_of_class);
  }
  if (!source->shares.empty()) {
    target_shares = ClassShares(target, settings.surroundings_radius, source->classes);
    target_around = target_shares.numbers();
    target_shares.forget_numbers();
  } else if (!source->around_price.is_free()) {
    target_around = make_surroundings(target, settings.surroundings_radius, source->classes);
  }
}

KernelView LevelState::view(int pass) const {
  KernelView view;
  view.target = &target;
  view.exemplars = &exemplars;
  view.lists = &lists;
  view.links = links.empty() ? nullptr : links.data();
  if (!target_around.empty()) {
    view.target_around = target_around.data();
    view.around_price = &source->around_price;
    view.target_shares = target_shares.empty() ? nullptr : &target_shares;
    view.texel_shares = source->shares.empty() ? nullptr : &source->shares;
    view.classes = source->classes;
    view.border_draws = settings.border_draws;
  }
  view.guides = source->guides.data();
  view.vector_weights = source->vector_weights.empty() ? nullptr : source->vector_weights.data();
  view.usual_error = source->usual_error.empty() ? nullptr : source->usual_error.data();
  view.match = match.data();
  view.fixed = fixed.empty() ? nullptr : fixed.data();
  view.piece_size = pieces.size().data();
  view.texels = &texels;
  view.has_cuts = source->has_cuts;
  view.bin_cost = bin_cost.data();
  view.reuse_q4 = reuse_q4.data();
  view.max_uses = max_uses.data();
  view.copy_cap = settings.copy_cap;
  view.replaces_pieces = settings.replacing_passes > 0;
  view.draws = settings.draws;
  view.fitting_draws = settings.fitting_draws;
  view.key = key_for(settings, Purpose::pass, pass);
  view.pass = pass;
  view.radius = settings.patch_radius;
  view.normalized = settings.normalized;
  return view;
}

}  // namespace belvedere::synth
