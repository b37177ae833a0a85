#include "renderer/mist/mist_billows.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/random_streams.h"

namespace belvedere {
namespace {

constexpr double shortest_m = 50.0;       // length of the first octave; each is twice as long as the one before
constexpr int octave_count = 12;          // up to 100 km
constexpr double length_units = 46.0;     // of the heaps that weigh most
constexpr double sigma_share = 0.2;       // deviation of the noise's blur, of the length of its heaps
constexpr double height_share = 0.085;    // of a heap, of its length
constexpr double roundness = 0.05;        // of the creases between heaps: 0 sharp
constexpr double mean_heap = 0.84;        // of √(n² + roundness), n normal
constexpr double highest_heap = 2.2;      // cut there, so that the surface has bounds
constexpr double octaves_together = 2.6;  // what the weights of the octaves sum to at most, in shares of the longest

// How much an octave says whose heaps are 2^steps as long as those that weigh most.
double weight_of(double steps) { return smoothstep(-2.4, -1.4, steps) * (1.0 - smoothstep(0.1, 1.0, steps)); }

}  // namespace

MistBillows::MistBillows(std::uint64_t seed, double strength, double highest_m)
    : strength_(strength), highest_m_(highest_m), reach_m_(strength * highest_m * octaves_together) {
  if (flat()) return;
  for (int k = 0; k < octave_count; ++k)
    octaves_.emplace_back(stream_seed(seed, Stream::mist_billows, static_cast<std::uint64_t>(k)), sigma_share * std::ldexp(shortest_m, k));
}

double MistBillows::length_m(double metres_per_unit) { return length_units * metres_per_unit; }

double MistBillows::height_m(glm::dvec2 place, double metres_per_unit) {
  if (flat()) return 0.0;
  const double longest_m = length_m(metres_per_unit);
  const double tallest_m = std::min(height_share * longest_m, highest_m_);
  const double octave = exact::log2(longest_m / shortest_m);
  double sum = 0.0;
  for (int k = std::max(0, static_cast<int>(octave) - 2); k < octave_count; ++k) {
    const double steps = k - octave;
    if (steps >= 1.0) break;
    const double weight = weight_of(steps);
    if (weight <= 0.0) continue;
    const double n = octaves_[static_cast<std::size_t>(k)](place.x, place.y);
    const double heap = std::min(std::sqrt(n * n + roundness), highest_heap) - mean_heap;
    sum += weight * exact::exp2(steps) * heap;
  }
  return strength_ * tallest_m * sum;
}

}  // namespace belvedere
