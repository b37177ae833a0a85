#pragma once

#include <cstdint>
#include <vector>

#include "texture/statistical/clique_flow.h"
#include "texture/statistical/seed_noise.h"

namespace belvedere {

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
