#include "texture/segment/clique_partition.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace belvedere {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

// Between two groups: sum of the weights, and number of pairs.
struct Groups {
  std::vector<double> sum;  // count × count
  std::vector<std::size_t> members;
  std::size_t count;
  double mean(std::size_t a, std::size_t b) const {
    return sum[a * count + b] / static_cast<double>(members[a] * members[b]);
  }
};

// The later group with the largest mean weight to this one; none if there is none.
std::size_t best_partner(const Groups& groups, std::size_t a) {
  std::size_t best = none;
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t b = a + 1; b < groups.count; ++b) {
    if (groups.members[b] == 0) continue;
    if (const double mean = groups.mean(a, b); mean > highest) {
      highest = mean;
      best = b;
    }
  }
  return best;
}

}  // namespace

Partition in_order(const Partition& groups) {
  constexpr std::uint16_t unmet = 65535;
  Partition number(65536, unmet);
  Partition out;
  out.reserve(groups.size());
  std::uint16_t next = 0;
  for (const std::uint16_t group : groups) {
    if (number[group] == unmet) number[group] = next++;
    out.push_back(number[group]);
  }
  return out;
}

Partition join_by_mean_weight(const PairWeights& weights) {
  const std::size_t count = weights.count();
  Groups groups{std::vector<double>(count * count, 0.0), std::vector<std::size_t>(count, 1), count};
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b)
      if (a != b) groups.sum[a * count + b] = weights(a, b);
  Partition of(count);
  for (std::size_t i = 0; i < count; ++i) of[i] = static_cast<std::uint16_t>(i);
  std::vector<std::size_t> partner(count);
  for (std::size_t a = 0; a < count; ++a) partner[a] = best_partner(groups, a);
  for (;;) {
    std::size_t a = none;
    double highest = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      if (groups.members[i] == 0 || partner[i] == none) continue;
      if (const double mean = groups.mean(i, partner[i]); mean > highest) {
        highest = mean;
        a = i;
      }
    }
    if (a == none) return in_order(of);
    const std::size_t b = partner[a];
    for (std::size_t c = 0; c < count; ++c) {
      groups.sum[a * count + c] += groups.sum[b * count + c];
      groups.sum[c * count + a] = groups.sum[a * count + c];
    }
    groups.members[a] += groups.members[b];
    groups.members[b] = 0;
    for (std::uint16_t& group : of)
      if (group == b) group = static_cast<std::uint16_t>(a);
    // Only means to one of the two have changed; a group whose partner was neither may have found a
    // better one in `a`.
    for (std::size_t i = 0; i < count; ++i) {
      if (groups.members[i] == 0) continue;
      if (i == a || partner[i] == a || partner[i] == b) {
        partner[i] = best_partner(groups, i);
      } else if (i < a && partner[i] != none) {
        const double now = groups.mean(i, a);
        const double before = groups.mean(i, partner[i]);
        if (now > before || (now == before && a < partner[i])) partner[i] = a;
      }
    }
  }
}

Partition move_singly(const PairWeights& weights, const Partition& start) {
  const std::size_t count = weights.count();
  Partition of = in_order(start);
  // One group more than things, so that one is always empty: becoming a group of its own is also a
  // move.
  const std::size_t groups = count + 1;
  std::vector<double> pull(count * groups, 0.0);  // of every group on every thing
  std::vector<std::size_t> members(groups, 0);
  for (std::size_t i = 0; i < count; ++i) {
    ++members[of[i]];
    for (std::size_t j = 0; j < count; ++j)
      if (i != j) pull[i * groups + of[j]] += weights(i, j);
  }
  // Smaller gains are rounding errors of sums.
  double scale = 0.0;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b) scale = std::max(scale, std::abs(weights(a, b)));
  const double min = 1e-9 * scale;
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t own = of[i];
      std::size_t best = own;
      double highest = pull[i * groups + own] + min;
      bool empty_seen = false;
      for (std::size_t g = 0; g < groups; ++g) {
        if (g == own || (members[g] == 0 && empty_seen)) continue;
        empty_seen = empty_seen || members[g] == 0;
        const double gain = members[g] == 0 ? 0.0 : pull[i * groups + g];
        if (gain > highest) {
          highest = gain;
          best = g;
        }
      }
      if (best == own) continue;
      --members[own];
      ++members[best];
      of[i] = static_cast<std::uint16_t>(best);
      for (std::size_t j = 0; j < count; ++j) {
        if (j == i) continue;
        pull[j * groups + own] -= weights(i, j);
        pull[j * groups + best] += weights(i, j);
      }
      moved = true;
    }
  }
  return in_order(of);
}

Partition partition_cliques(const PairWeights& weights) {
  return move_singly(weights, join_by_mean_weight(weights));
}

}  // namespace belvedere
