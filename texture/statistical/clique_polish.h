#pragma once

#include <cstdint>
#include <vector>

#include "texture/statistical/clique_flow.h"
#include "texture/statistical/seed_noise.h"

namespace belvedere {

// The polish: a Gibbs field over the clique types of one level, sampled pixel by pixel from what the flow has reached (Zalesny et al. 2005,
// but from there and not from noise). Its moves to a neighbour's whole colour make dabs with edges where the flow leaves soft blobs.
struct PolishParameters {
  int sweeps = 30;          // 15 are almost as good, 60 no better
  double correction = 0.3;  // of a potential after each sweep, of the logarithm of what a bin has too much; falls over the last third
  // Added to shares of a bin before the logarithm. What hardly ever occurs would else draw stronger with each sweep until it
  // gathers in specks: bright clots in the dark, many at 1e-4, few at 4e-3.
  double share_floor = 4e-3;
  std::uint64_t seed = 1;
  bool settle = true;  // three rounds of the flow after the last sweep
};
inline constexpr double sampler_share_floor = 1e-4;  // of the published method, from noise and without the flow: an oracle, left as it was

// The potentials of each sweep, for windows: recorded where a texture is learnt to be made endlessly, and then taken instead of counting.
struct PolishRecord {
  std::vector<std::vector<float>> sweeps;  // potential_bins values for each type of the level
  std::vector<FlowRound> rounds;           // of the flow between sweeps and after them
};
inline constexpr int potential_bins = 256;

// Changes the picture at `level`. `place`, in pixels of that level, is where the picture lies on an endless texture. With `replay` tables
// come from there; with `record` they go there.
void polish(FlowState& state, const CliqueModel& model, int level, const PolishParameters& parameters, TexturePlace place,
            const PolishRecord* replay = nullptr, PolishRecord* record = nullptr);

}  // namespace belvedere
