#include "texture/quality/quality_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace belvedere::quality {

double quantile(const std::size_t* counts, std::size_t values, double at) {
  const std::size_t total = std::accumulate(counts, counts + values, std::size_t{0});
  const double rank = at * static_cast<double>(total - 1);
  const auto value_at = [&](std::size_t nth) {
    std::size_t below = 0;
    for (std::size_t v = 0; v < values; ++v) {
      below += counts[v];
      if (nth < below) return static_cast<double>(v);
    }
    return static_cast<double>(values - 1);
  };
  const std::size_t lower = static_cast<std::size_t>(rank);
  const double low = value_at(lower);
  return low + (value_at(std::min(total - 1, lower + 1)) - low) * (rank - std::floor(rank));
}

double wasserstein(const Histogram& a, const Histogram& b) {
  constexpr std::size_t steps = 256;
  const auto quantiles = [](const Histogram& h) {
    std::array<double, steps> out{};
    const double total = std::accumulate(h.begin(), h.end(), 0.0);
    double below = h[0];
    std::size_t value = 0;
    for (std::size_t i = 0; i < steps; ++i) {
      const double rank = (static_cast<double>(i) + 0.5) / steps * total;
      while (value + 1 < h.size() && below <= rank) below += h[++value];
      out[i] = static_cast<double>(value);
    }
    return out;
  };
  const std::array<double, steps> qa = quantiles(a);
  const std::array<double, steps> qb = quantiles(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < steps; ++i) sum += std::abs(qa[i] - qb[i]);
  return sum / steps;
}

namespace {

constexpr std::array<std::array<int, 2>, 20> clique_steps{
    {{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 0},  {0, 2},  {4, 0},  {0, 4},  {4, 4},   {4, -4},
     {8, 0}, {0, 8}, {8, 8}, {8, -8}, {16, 0}, {0, 16}, {12, 6}, {6, 12}, {12, -6}, {6, -12}}};
using Differences = std::array<double, 64>;

// Adds the differences (first minus second pixel, first the left one) of a picture to a histogram;
// returns their number.
std::size_t add_differences(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels,
                            std::uint8_t label, int dx, int dy, const Grid<float>* weights,
                            Differences& counts) {
  std::size_t pairs = 0;
  for (int y = std::max(0, -dy); y < picture.height() - std::max(0, dy); ++y) {
    for (int x = 0; x + dx < picture.width(); ++x) {
      if (labels(x, y) != label || labels(x + dx, y + dy) != label) continue;
      const int difference = sum_of(picture(x, y)) -
                             sum_of(picture(x + dx, y + dy));  // three times the difference of grey
      counts[static_cast<std::size_t>((difference + 768) / 24)] +=
          weights == nullptr ? 1.0 : static_cast<double>((*weights)(x, y));
      ++pairs;
    }
  }
  return pairs;
}

double difference(const Differences& a, const Differences& b) {
  const double of_a = std::accumulate(a.begin(), a.end(), 0.0);
  const double of_b = std::accumulate(b.begin(), b.end(), 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] / of_a - b[i] / of_b);
  return sum;
}

}  // namespace

CliqueDistances clique_distances(const Grid<Rgb8>& output, const Grid<std::uint8_t>& labels,
                                 const std::vector<Exemplar>& exemplars,
                                 const std::vector<Grid<float>>& weights, std::uint8_t label) {
  constexpr std::size_t fewest_pairs = 500;
  CliqueDistances sums;
  int compared = 0;
  for (const auto& [dx, dy] : clique_steps) {
    Differences of_output{};
    Differences plain{};
    Differences reweighted{};
    std::size_t offered = 0;
    const std::size_t made = add_differences(output, labels, label, dx, dy, nullptr, of_output);
    for (std::size_t e = 0; e < exemplars.size(); ++e) {
      offered += add_differences(exemplars[e].picture, exemplars[e].guides.label, label, dx, dy,
                                 nullptr, plain);
      add_differences(exemplars[e].picture, exemplars[e].guides.label, label, dx, dy, &weights[e],
                      reweighted);
    }
    if (made < fewest_pairs || offered < fewest_pairs) continue;
    sums.distance += difference(of_output, plain);
    sums.floor += difference(reweighted, plain);
    sums.beyond_floor += difference(of_output, reweighted);
    ++compared;
  }
  if (compared > 0)
    sums = {sums.distance / compared, sums.floor / compared, sums.beyond_floor / compared};
  return sums;
}

}  // namespace belvedere::quality
