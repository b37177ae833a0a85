#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

namespace belvedere::test {

// Similarity of two divisions of the same things, corrected for chance: 1 equal, 0 as by chance
// (Hubert and Arabie 1985).
inline double adjusted_rand_index(std::span<const std::uint8_t> a,
                                  std::span<const std::uint8_t> b) {
  std::map<std::pair<int, int>, double> both;
  std::map<int, double> of_a;
  std::map<int, double> of_b;
  for (std::size_t i = 0; i != a.size(); ++i) {
    both[{a[i], b[i]}] += 1.0;
    of_a[a[i]] += 1.0;
    of_b[b[i]] += 1.0;
  }
  const auto pairs = [](const auto& counts) {
    double sum = 0.0;
    for (const auto& [key, n] : counts) sum += 0.5 * n * (n - 1.0);
    return sum;
  };
  const double all = 0.5 * static_cast<double>(a.size()) * (static_cast<double>(a.size()) - 1.0);
  const double together = pairs(both);
  const double in_a = pairs(of_a);
  const double in_b = pairs(of_b);
  const double expected = in_a * in_b / std::max(all, 1.0);
  const double max = 0.5 * (in_a + in_b);
  return max == expected ? 1.0 : (together - expected) / (max - expected);
}

}  // namespace belvedere::test
