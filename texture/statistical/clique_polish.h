#pragma once

#include <cstdint>
#include <vector>

#include "texture/statistical/band_pyramid.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/seed_noise.h"

namespace belvedere {

// The flow: all histograms of differences are moved to the model's together, in rounds, as a
// transport: each difference towards the value of the same quantile in the model. It achieves in a
// second what sampling pixel by pixel takes half a minute for.

// How far a difference of a type should move, at the edges of its histogram's bins; linear between
// them.
using FlowTable = std::vector<float>;
// Tables of all types of the levels in a round, in the model's order from `level` to the coarsest.
using FlowRound = std::vector<FlowTable>;

struct FlowStep {
  float rate = 0.8F;  // factor on the mean of the requests of a pixel's cliques; above 1 several
                      // levels together overshoot
  float momentum = 0.6F;  // share of the last round's move that continues; 0 in the last rounds, so
                          // that the result is stable
};

// A texture in progress: pictures of all levels and the moves of the current level.
struct FlowState {
  BandPyramid pyramid;
  BandPicture speed;  // of the finest current level; sized by the first round at a level
};

// Tables that move the differences of `picture` to the model's.
FlowRound find_tables(const BandPyramid& pyramid, const CliqueModel& model, int level);
// One round at `level`: the coarser levels are recomputed from it, evaluated with `tables`, and
// their requests are propagated down.
void flow(FlowState& state, const CliqueModel& model, int level, const FlowRound& tables,
          FlowStep step);

// Makes coarser pictures from the one at `level`.
void renew_coarser(BandPyramid& pyramid, int level);

// The polish: a Gibbs field over the clique types of one level, sampled pixel by pixel from the
// result of the flow (as in Zalesny et al. 2005, who begin with noise). Its moves to a neighbour's
// whole colour make dabs with edges where the flow leaves soft blobs.
struct PolishParameters {
  int sweeps = 30;          // 15 are almost as good, 60 not better
  double correction = 0.3;  // of a potential after each sweep, times the logarithm of a bin's
                            // relative excess; falls over the last third
  // Added to shares of a bin before the logarithm. Otherwise very rare differences would get
  // stronger with each sweep until they gather in specks: bright clots in the dark, many at 1e-4,
  // few at 4e-3.
  double share_floor = 4e-3;
  std::uint64_t seed = 1;
  bool resolve = true;  // three rounds of the flow after the last sweep
};
inline constexpr double sampler_share_floor =
    1e-4;  // of the published method, from noise and without the flow: a reference, kept unchanged

// The potentials of each sweep, for windows: recorded when a texture is prepared for unbounded
// synthesis, and then used instead of counting.
struct PolishRecord {
  std::vector<std::vector<float>> sweeps;  // potential_bins values for each type of the level
  std::vector<FlowRound> rounds;           // of the flow between sweeps and after them
};
inline constexpr int potential_bins = 256;

// Changes the picture at `level`. `position`, in pixels of that level, is the picture's position on
// an unbounded texture. With `replay` tables are taken from there; with `record` they are stored
// there.
void polish(FlowState& state, const CliqueModel& model, int level,
            const PolishParameters& parameters, TexturePosition position,
            const PolishRecord* replay = nullptr, PolishRecord* record = nullptr);

}  // namespace belvedere
