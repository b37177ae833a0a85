#include <algorithm>
#include <array>

#include "base/random.h"
#include "texture/synthesis/synth_kernel.h"

// Candidates for a pixel: picks from the lists, and those that silhouettes forbid.
namespace belvedere::synth {

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
  slack.others = nullptr;  // picks are as good as possible
  std::uint32_t best = view.exemplars->nowhere();
  std::int64_t best_cost = INT64_MAX;
  for (std::uint32_t i = 0; i < std::min(run.count, static_cast<std::uint32_t>(draws)); ++i) {
    const PickLists::Entry entry = view.lists->entry(run.entry(i));
    const std::int64_t cost = guide_cost(view, requested, entry.guides(), slack) +
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
