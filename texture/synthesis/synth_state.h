#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/random.h"
#include "texture/synthesis/synth_kernel.h"
#include "texture/synthesis/synth_lists.h"
#include "texture/synthesis/synth_pieces.h"
#include "texture/synthesis/synth_plane.h"
#include "texture/synthesis/synth_texels.h"

namespace belvedere::synth {

// Settings of one level of the pyramid.
struct LevelSettings {
  int level = 0;  // 0 is the finest
  std::uint64_t seed = 1;
  int passes = 4;
  int replacing_passes =
      0;  // further ones; pieces over the cap are moved as a whole before the last 1 + this many
  std::int64_t copy_cap = 1;  // pixels
  std::int64_t reuse_price = price::reuse;
  int draws = 1;          // texels drawn for one pick
  int border_draws = 4;   // the same where other classes are nearby
  int fitting_draws = 4;  // the same in sub-passes, which compare the existing paint
  int min_window = 16;    // texels that a pick's window must contain
  int surroundings_radius = 8;
  int patch_radius = synth::patch_radius;
  bool normalized = false;        // the mean difference of two patches' lightness costs nothing
  bool all_surroundings = false;  // all classes around count, not only the most common other one
  int tile = 0;  // side of the tiles that sub-passes work in, even; 0: whole rows. Does not change
                 // the result
};
// The default settings for a level; cap and reuse as in SynthesisParameters.
LevelSettings settings_for_level(int level, std::uint64_t seed, int copy_cap, double reuse);

// Keys of random numbers by purpose on a level.
enum class Purpose : std::uint64_t {
  start = 1,
  expectation = 2,
  moves = 3,
  cells = 4,
  errors = 5,
  alone = 6,
  pass = 16
};

inline std::uint64_t key_for(const LevelSettings& settings, Purpose purpose, int number = 0) {
  return random_bits(stream_seed(settings.seed, Stream::synthesis), settings.level, number,
                     static_cast<std::uint64_t>(purpose));
}

// Data of a level of the exemplars: made once, the same for every window of a sheet. Only the uses
// in its records change: those of the current window, all 0 before and after.
struct LevelSource {
  const Plane& exemplars;
  bool has_cuts = false;  // silhouettes, in the records of texels
  int classes = 0;
  std::vector<GuideRole> guides;
  std::vector<std::uint32_t> vector_weights;  // empty: guides are priced one by one
  SurroundingsPrice around_price;
  ClassShares shares;  // empty: only the most common other class is priced
  TexelRecords texels;
  PickLists lists;
  std::vector<std::uint8_t> usual_error;  // by class × guide: median error of picks; empty: unknown

  LevelSource(const LevelSettings& settings, const std::vector<GuideRole>& guides, int classes,
              const Plane& exemplars, const TexelDemand& demand,
              const SurroundingsPrice& around_price);

 private:
  LevelSource(const LevelSettings& settings, const std::vector<GuideRole>& guides, int classes,
              const Plane& exemplars, const TexelDemand& demand,
              const SurroundingsPrice& around_price, ClassShares shares);
  LevelSource(const LevelSettings& settings, const std::vector<GuideRole>& guides, int classes,
              const Plane& exemplars, const TexelDemand& demand,
              const SurroundingsPrice& around_price, ClassShares shares,
              const std::vector<Surroundings>& offered_around);
};

// The state of a level. Inputs are the exemplars and the target's classes and guides; passes change
// the match field, and with it the target's colours. All running sums (uses, bins) commute, so the
// order of work does not matter.
struct LevelState {
  LevelSettings settings;
  std::shared_ptr<LevelSource> source;  // shared by copies of a state
  const Plane& exemplars;               // of the source, as are the next two
  TexelRecords& texels;
  const PickLists& lists;
  Plane& target;
  std::vector<std::uint8_t> links;          // empty: no silhouettes
  std::vector<Surroundings> target_around;  // by target index; empty: surroundings are not priced
  ClassShares target_shares;                // empty if the source's are
  std::vector<std::uint32_t> fixed;         // by target index: the texel a pixel must keep, or
                                            // exemplars.nowhere(); empty: all are free
  std::vector<std::uint32_t>
      match;  // by target index: exemplar index, exemplars.nowhere() in padding and without class
  std::vector<std::uint32_t>
      next;  // matches found by a sub-pass: every second pixel of every second row
  std::vector<std::int32_t> bins_expected;  // by class × 64 + bin: expected uses from picks alone
  std::vector<std::int32_t> bins_actual;
  std::vector<std::int32_t> bin_cost;
  std::vector<std::int32_t> bin_cost_kept;  // from round to round
  std::vector<std::int64_t> reuse_q4;       // by class
  std::vector<std::uint32_t> max_uses;      // by class
  std::vector<std::uint32_t> widened;       // pixels, by target index, that copy from outside their
                                            // window so that no texel is used too often
  Pieces pieces;

  // Target classes without texels on this level become no_class. `links` may be empty.
  LevelState(const LevelSettings& settings, std::shared_ptr<LevelSource> source, Plane& target,
             std::vector<std::uint8_t> links);
  // A state with its own source, for the requests of this target.
  LevelState(const LevelSettings& settings, const std::vector<GuideRole>& guides, int classes,
             const Plane& exemplars, Plane& target, std::vector<std::uint8_t> links,
             const SurroundingsPrice& around_price = no_surroundings());
  KernelView view(int pass) const;
};

// By class × guide: the median error of each guide over the picks of a sample of a class's pixels.
std::vector<std::uint8_t> usual_errors_of_picks(const LevelState& state);

}  // namespace belvedere::synth
