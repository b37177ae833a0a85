#include "renderer/mist/mist_billows.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/random_streams.h"

namespace belvedere {
namespace {

constexpr double shortest_m =
    50.0;  // length of the first octave; each is twice as long as the one before
constexpr int octave_count = 13;       // up to 200 km
constexpr double length_units = 46.0;  // of the heaps that are seen as heaps; swells are longer
constexpr double sigma_share =
    0.2;  // deviation of the noise's blur, relative to the length of its heaps
constexpr double height_share = 0.055;    // of a heap, relative to its length
constexpr double roundness = 0.05;        // of the creases between heaps: 0 sharp
constexpr double mean_heap = 0.84;        // of √(n² + roundness), n normal
constexpr double highest_heap = 2.2;      // clipped there, so that the surface is bounded
constexpr double octaves_together = 6.5;  // max sum of the octaves, in heights of heaps
constexpr double busy_steps =
    2.6;  // how much longer than heaps the calm and busy areas are, in octaves

// Height of an octave whose heaps are 2^steps as long as the visible heaps: swells are long and
// flat.
double height_of(double steps) {
  const double weight = smoothstep(-2.2, -0.9, steps) * (1.0 - smoothstep(1.5, 2.5, steps));
  return weight <= 0.0 ? 0.0 : weight * exact::exp2(steps > 0.0 ? 0.5 * steps : steps);
}

}  // namespace

MistBillows::MistBillows(std::uint64_t seed, double strength, double highest_m)
    : strength_(strength),
      highest_m_(highest_m),
      reach_m_(strength * highest_m * octaves_together) {
  if (flat()) return;
  for (int k = 0; k < octave_count; ++k)
    octaves_.emplace_back(stream_seed(seed, Stream::mist_billows, static_cast<std::uint64_t>(k)),
                          sigma_share * std::ldexp(shortest_m, k));
}

double MistBillows::length_m(double metres_per_unit) { return length_units * metres_per_unit; }

// Noise of deviation about 1 whose patches are 2^steps as long as heaps: a mixture of two octaves.
double MistBillows::patches(glm::dvec2 position, double octave) {
  const double below = std::floor(octave);
  const double share = octave - below;
  const auto of = [&](double k) {
    const auto number = static_cast<std::size_t>(std::clamp(k, 0.0, octave_count - 1.0));
    return static_cast<double>(octaves_[number](position.y, -position.x));
  };
  return ((1.0 - share) * of(below) + share * of(below + 1.0)) /
         std::sqrt((1.0 - share) * (1.0 - share) + share * share);
}

double MistBillows::height_m(glm::dvec2 position, double metres_per_unit) {
  if (flat()) return 0.0;
  const double longest_m = length_m(metres_per_unit);
  const double tallest_m = std::min(height_share * longest_m, highest_m_);
  const double octave = exact::log2(longest_m / shortest_m);
  // Heaps gather in groups; between them the sea is calm.
  const double busy = std::clamp(0.60 + 0.45 * patches(position, octave + busy_steps), 0.10, 1.2);
  double sum = 0.0;
  for (int k = std::max(0, static_cast<int>(octave) - 2); k < octave_count; ++k) {
    const double steps = k - octave;
    if (steps >= 2.5) break;
    const double height = height_of(steps);
    if (height <= 0.0) continue;
    const double n = octaves_[static_cast<std::size_t>(k)](position.x, position.y);
    const double heap = std::min(std::sqrt(n * n + roundness), highest_heap) - mean_heap;
    sum += (steps < 1.0 ? busy : 1.0 - (1.0 - busy) * std::max(0.0, 2.0 - steps)) * height * heap;
  }
  return strength_ * tallest_m * sum;
}

}  // namespace belvedere
