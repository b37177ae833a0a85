#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "texture/synthesis/synth_lists.h"
#include "texture/synthesis/synth_plane.h"
#include "texture/synthesis/synth_surroundings.h"
#include "texture/synthesis/synth_texels.h"

namespace belvedere::synth {

// The hot loop of synthesis: the cost of a candidate, and the cheapest candidate of a pixel.
// Compiled for several vector widths, chosen at start-up; integer arithmetic, so all widths give
// the same numbers.

// Prices of the cost function, in the units of the patch distance (1 = an eighth of a weighted
// squared 8-bit difference).
namespace price {
inline constexpr std::int64_t distance_shift = 3;     // weighted squared differences >> 3
inline constexpr std::int64_t class_mismatch = 3000;  // a pixel of the patch whose class differs
inline constexpr std::int64_t guide = 270;            // a squared difference of a guide of weight 1
inline constexpr std::int64_t surroundings_q8 =
    32;  // Σ_k of squared differences of class shares (of 255), in 256ths
inline constexpr std::int64_t grey = 16;  // a squared difference at one of the 8 positions, in
                                          // picks: the total of the patch's weights
inline constexpr std::int64_t reuse =
    2000;  // n (n + 1) / 2 times, for a texel used n times by others
inline constexpr std::int64_t bin = 15000;   // a bin used twice as often as expected
inline constexpr std::int64_t join = 60000;  // joining a piece close to the cap
inline constexpr std::int64_t misfit =
    300000;  // a member of a moved piece that would leave its class
}  // namespace price

// A neighbourhood by its radius R: the weight of a pixel, round(16 exp(-9 r² / 8 R²)) by |dx| and
// |dy|, which for 7 × 7 is exp(-r² / 8); and a factor that scales other sizes to 7 × 7, so that
// prices keep their meaning: all weights sum to 348, all mismatches of class to 49 ×
// class_mismatch. The sum of weighted squares and mismatches is multiplied by scale_q8 / 256.
struct PatchShape {
  int weights[largest_patch_radius + 1][largest_patch_radius + 1];
  int mismatch;  // of a pixel, before scaling and distance_shift
  int scale_q8;
};
inline constexpr PatchShape patch_shapes[largest_patch_radius + 1] = {
    {},
    {{{16, 5}, {5, 2}}, 16519, 2025},
    {{{16, 12, 5}, {12, 9, 4}, {5, 4, 2}}, 21620, 557},
    {{{16, 14, 10, 5}, {14, 12, 9, 5}, {10, 9, 6, 3}, {5, 5, 3, 2}},
     price::class_mismatch << price::distance_shift,
     256},
    {{{16, 15, 12, 8, 5}, {15, 14, 11, 8, 5}, {12, 11, 9, 6, 4}, {8, 8, 6, 5, 3}, {5, 5, 4, 3, 2}},
     24778,
     150},
    {{{16, 15, 13, 11, 8, 5},
      {15, 15, 13, 10, 7, 5},
      {13, 13, 11, 9, 7, 4},
      {11, 10, 9, 7, 5, 3},
      {8, 7, 7, 5, 4, 3},
      {5, 5, 4, 3, 3, 2}},
     25388,
     98}};

// Share of other classes, of 255, from which a pixel counts as at a border.
inline constexpr int border_others = 64;

// Guides priced by one vector operation; each plane's guides are readable this far from any texel's
// first.
inline constexpr int vector_guides = 8;

// All inputs of pricing. Pointers into the state of a level (synth_level.h); nothing is owned.
struct KernelView {
  const Plane* target = nullptr;
  const Plane* exemplars = nullptr;
  const PickLists* lists = nullptr;
  const std::uint8_t* links = nullptr;          // by target index; null: no silhouettes
  const Surroundings* target_around = nullptr;  // by target index: classes around; null: not priced
  const SurroundingsPrice* around_price = nullptr;
  const ClassShares* target_shares =
      nullptr;  // null: Surroundings are the most common other class and the share of all others
  const ClassShares* texel_shares =
      nullptr;  // with these they are numbers of the target's and of the texels' kinds
  int classes = 0;
  const GuideRole* guides = nullptr;  // exemplars->guide_count of them
  const std::uint32_t* vector_weights =
      nullptr;  // vector_guides weights, 0 beyond the last; null: one by one
  const std::uint8_t* usual_error =
      nullptr;  // by class × guide_count + guide: typical error of picks; null: not known yet
  const std::uint32_t* match = nullptr;  // by target index: exemplar index
  const std::uint32_t* fixed =
      nullptr;  // by target index: the texel a pixel must keep, or nowhere; null: all are free
  const std::uint16_t* piece_size =
      nullptr;  // by target index: size of the pixel's piece, saturated
  const TexelRecords* texels =
      nullptr;            // uses, bins, surroundings and guides of the exemplars' texels
  bool has_cuts = false;  // the exemplars have silhouettes
  const std::int32_t* bin_cost = nullptr;  // by class × 64 + bin
  const std::int64_t* reuse_q4 = nullptr;  // by class: price of reuse in sixteenths
  const std::uint32_t* max_uses =
      nullptr;                   // by class: a texel with so many other uses is no longer offered
  std::int64_t copy_cap = 0;     // max pixels of a piece
  bool replaces_pieces = false;  // whether pieces over the cap are moved as a whole on this level
  int draws = 1;                 // texels drawn for one pick
  int border_draws = 1;          // the same where other classes are nearby
  int fitting_draws = 1;         // the same where the existing paint is compared; 1: it is not
  std::uint64_t key = 0;         // of the random numbers of this pass
  int pass = 0;
  int radius = patch_radius;  // of neighbourhoods, 1 … largest_patch_radius; determines the padding
                              // of planes
  bool normalized = false;  // the mean difference of two patches' lightness costs nothing

  bool is_fixed(std::uint32_t pixel) const {
    return fixed != nullptr && fixed[pixel] != exemplars->nowhere();
  }
};

// Free tolerance of a pixel's guides: about the typical error of picks (one step less for the
// sorted guide, because copying along causes most of its error). For the two guides that order the
// lists it is the window, for the others the usual error of picks. Without it, many guides that no
// texel can meet together would destroy the texture for no gain.
struct Slack {
  std::int32_t sorted = 0;
  std::int32_t bucketed = 0;
  const std::uint8_t* others = nullptr;  // by guide, from 2 on; null: no tolerance
};
Slack make_slack(const KernelView& view, std::uint32_t pixel);

// What the exemplar of a texel lacks: a guide that it does not know costs the same for every pixel,
// instead of a difference.
struct Lacking {
  const std::uint8_t* known = nullptr;  // by guide: 255, or 0 where it lacks it; null: lacks none
  std::int64_t price = 0;
};
inline Lacking lacking_of(const Plane& exemplars, std::uint32_t texel, std::uint32_t label_class) {
  if (exemplars.known.empty()) return {};
  const std::size_t part = static_cast<std::size_t>(exemplars.part_of(texel));
  return {exemplars.known.data() + part * static_cast<std::size_t>(exemplars.guide_count),
          exemplars.lacking_price[part * 256 + label_class]};
}

inline std::int64_t guide_cost(const KernelView& view, const std::uint8_t* requested,
                               const std::uint8_t* offered, Slack slack, Lacking lacking = {}) {
  const auto price_of = [&](int g, int free) {
    if (lacking.known != nullptr && lacking.known[g] == 0) return std::int64_t{0};
    const std::int32_t off = std::max(0, std::abs(requested[g] - offered[g]) - free);
    return view.guides[g].weight_q4 * off * off;
  };
  const int count = view.exemplars->guide_count;
  std::int64_t cost = 0;
  if (count > 0) cost += price_of(0, slack.sorted);
  if (count > 1) cost += price_of(1, slack.bucketed);
  for (int g = 2; g < count; ++g)
    cost += price_of(g, slack.others == nullptr ? 0 : slack.others[g]);
  return (cost >> 4) + lacking.price;
}
// A texel of the pixel's class from the window of its guides: of `draws` consecutive list entries
// from a random one on, the one with the cheapest guides and surroundings. Nowhere if the class has
// no texel.
std::uint32_t draw_texel(const KernelView& view, std::uint32_t pixel, std::uint64_t key, int x,
                         int y, Slack slack);
// The same in two steps, so that other draws can begin while memory is fetched.
// `widen`: from a window twice as wide for each step, for pixels whose own window has too few
// texels.
PickRun begin_draw(const KernelView& view, std::uint32_t pixel, std::uint64_t key, int x, int y,
                   int widen = 0);
std::uint32_t finish_draw(const KernelView& view, std::uint32_t pixel, const PickRun& run,
                          Slack slack);
// Finishes a draw with the one of `fitting_draws` texels that also matches the existing paint
// around the pixel best; used by sub-passes. As finish_draw where a silhouette cuts the patch.
std::uint32_t finish_fitting_draw(const KernelView& view, std::uint32_t pixel, const PickRun& run,
                                  Slack slack);

// The cost of the classes around a texel; 0 if they are not priced.
inline std::int64_t surroundings_cost(const KernelView& view, Surroundings requested,
                                      Surroundings offered) {
  if (view.around_price == nullptr) return 0;
  if (view.target_shares == nullptr) return (*view.around_price)(requested, offered);
  return shares_cost(view.target_shares->of(requested), view.texel_shares->of(offered),
                     *view.around_price, view.classes);
}

// Texels that a pixel must not copy, because a neighbour across a silhouette, of the picture or of
// the exemplar, copies with the same offset: no piece continues behind a ridge.
struct Forbidden {
  std::array<std::uint32_t, 4> texels{};
  int count = 0;
  bool has(std::uint32_t texel) const {
    return std::find(texels.begin(), texels.begin() + count, texel) != texels.begin() + count;
  }
};
// Whether a neighbour's texel and the one that continues it, by (dx, dy) back to the pixel, show
// one surface.
inline bool continues(const KernelView& view, std::uint32_t neighbours_texel, int dx, int dy) {
  return !view.has_cuts || !view.texels->is_cut(neighbours_texel, -dx, -dy, view.exemplars->stride);
}
// The texels forbidden to a pixel; with `all_neighbours` also those by the offsets of linked
// neighbours: a pixel that copies none of these is a piece of its own.
Forbidden forbidden_texels(const KernelView& view, std::uint32_t pixel,
                           bool all_neighbours = false);

// A texel of the pixel's class that is not forbidden: a pick, or the first one; its current one if
// there is no other.
std::uint32_t allowed_texel(const KernelView& view, std::uint32_t pixel, const Forbidden& forbidden,
                            std::uint64_t key, int x, int y);

// Flags of which of the (2 radius + 1)² pixels around (bit x of row y) are on the pixel's own
// surface, reached by linked steps inside the window.
using SurfaceRows = std::array<std::uint16_t, 2 * largest_patch_radius + 1>;
SurfaceRows surface_around(const KernelView& view, std::uint32_t pixel);

// Finds the best candidate of every second pixel of row y from x0 on and before x1, into next[0]
// onwards.
void improve_row(const KernelView& view, int x0, int x1, int y, std::uint32_t* next);
// Patch distance and class mismatches together, as improve_row prices them.
std::int64_t patch_cost(const KernelView& view, std::uint32_t pixel, std::uint32_t texel);
// The guides' price of a texel for a pixel, as improve_row computes it: guide_cost, however many at
// once.
std::int64_t guides_cost(const KernelView& view, std::uint32_t pixel, std::uint32_t texel);

// A sampled pixel of a piece that may be moved as a whole.
struct PieceSample {
  std::uint32_t pixel = 0;
  int dx = 0;  // from the piece's reference pixel
  int dy = 0;
};
// Finds the cheapest move of a piece, in which each sample copies from a candidate's texel plus its
// (dx, dy): the index into `candidates` (exemplar indices for the reference pixel), or -1 if there
// is none. Ties go to the first.
int best_move(const KernelView& view, const std::vector<PieceSample>& samples,
              const std::vector<std::uint32_t>& candidates);

// The vector instruction sets that this machine supports, best first. use_vector_target selects one
// of them ("" for the best), for tests.
std::vector<std::string> vector_targets();
void use_vector_target(const std::string& name);

}  // namespace belvedere::synth
