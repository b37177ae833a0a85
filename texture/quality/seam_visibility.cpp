#include "texture/quality/seam_visibility.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <numeric>

namespace belvedere {
namespace {

// Steps between 4-neighbours: their number, and the sum of |R − R'| + |G − G'| + |B − B'|, exact in
// integers.
struct Steps {
  std::uint64_t sum = 0;
  std::uint64_t count = 0;
  void add(int step) {
    sum += static_cast<std::uint64_t>(step);
    ++count;
  }
  double mean() const { return static_cast<double>(sum) / static_cast<double>(count); }
};

int step_between(const Rgb8& a, const Rgb8& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

// Texels of a class by value, for the three channels.
using ChannelHistograms = std::array<std::array<std::uint64_t, 256>, 3>;

// Mean step between texels picked independently: E|A − B| = Σ over v of P(A ≤ v) P(B > v) + P(B ≤
// v) P(A > v), summed over channels.
double chance_step(const ChannelHistograms& a, const ChannelHistograms& b) {
  double step = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto total = [c](const ChannelHistograms& of) {
      return static_cast<double>(std::accumulate(of[c].begin(), of[c].end(), std::uint64_t{0}));
    };
    const double all_a = total(a);
    const double all_b = total(b);
    double below_a = 0.0;
    double below_b = 0.0;
    for (std::size_t v = 0; v < 256; ++v) {
      below_a += static_cast<double>(a[c][v]);
      below_b += static_cast<double>(b[c][v]);
      step += (below_a * (all_b - below_b) + below_b * (all_a - below_a)) / (all_a * all_b);
    }
  }
  return step;
}

// Steps between a painting's own neighbours, by pair of classes (the lower label first), and at
// borders of any two classes.
struct OwnSteps {
  std::vector<Steps> by_pair = std::vector<Steps>(std::size_t{256} * 256);
  Steps borders;
  double borders_by_chance =
      0.0;  // the expected borders.sum if the texels there were random ones of their classes
  std::map<std::uint8_t, ChannelHistograms> colours;
  const Steps& of(std::uint8_t a, std::uint8_t b) const {
    return by_pair[std::size_t{std::min(a, b)} * 256 + std::max(a, b)];
  }
};

OwnSteps own_steps(const Exemplar& exemplar) {
  OwnSteps own;
  const Grid<std::uint8_t>& labels = exemplar.guides.label;
  const auto look = [&](int x, int y, int u, int v) {
    if (!labels.contains(u, v)) return;
    const std::uint8_t a = labels(x, y);
    const std::uint8_t b = labels(u, v);
    if (a == unused_label || b == unused_label) return;
    const int step = step_between(exemplar.picture(x, y), exemplar.picture(u, v));
    own.by_pair[std::size_t{std::min(a, b)} * 256 + std::max(a, b)].add(step);
    if (a != b) own.borders.add(step);
  };
  for (int y = 0; y < labels.height(); ++y) {
    for (int x = 0; x < labels.width(); ++x) {
      look(x, y, x + 1, y);
      look(x, y, x, y + 1);
      if (labels(x, y) == unused_label) continue;
      ChannelHistograms& colours = own.colours[labels(x, y)];
      for (std::size_t c = 0; c < 3; ++c) ++colours[c][exemplar.picture(x, y)[c]];
    }
  }
  for (const auto& [a, of_a] : own.colours) {
    for (const auto& [b, of_b] : own.colours) {
      const std::uint64_t count = a < b ? own.of(a, b).count : 0;
      if (count > 0) own.borders_by_chance += static_cast<double>(count) * chance_step(of_a, of_b);
    }
  }
  return own;
}

// The mean of both paintings' means, or that of one if the other has no such pair; negative if
// neither has.
double mean_of_both(const Steps& a, const Steps& b) {
  if (a.count == 0 && b.count == 0) return -1.0;
  if (a.count == 0) return b.mean();
  return b.count == 0 ? a.mean() : (a.mean() + b.mean()) / 2.0;
}

// The expected step at a border of two classes that no painting has side by side: that of random
// texels, times the ratio of actual to random steps at the paintings' other borders; negative if
// there are none.
double step_of_strangers(const OwnSteps& a, std::uint8_t label, const OwnSteps& b,
                         std::uint8_t other) {
  const double by_chance = a.borders_by_chance + b.borders_by_chance;
  const auto of_a = a.colours.find(label);
  const auto of_b = b.colours.find(other);
  if (by_chance <= 0.0 || of_a == a.colours.end() || of_b == b.colours.end()) return -1.0;
  return chance_step(of_a->second, of_b->second) *
         static_cast<double>(a.borders.sum + b.borders.sum) / by_chance;
}

// Sums over the seams of one kind.
struct SeamSums {
  Steps all;
  Steps compared;
  double usual = 0.0;

  SeamVisibility visibility() const {
    SeamVisibility of;
    of.pairs = all.count;
    of.compared = compared.count;
    if (all.count > 0) of.step = all.mean() / 3.0;
    if (usual > 0.0) of.visibility = static_cast<double>(compared.sum) / usual;
    return of;
  }
};

}  // namespace

SeamsOfKinds seam_visibility(const MatchField& matches, const std::vector<Exemplar>& exemplars,
                             const Grid<float>& depth_m, float depth_ratio) {
  std::vector<OwnSteps> own;
  own.reserve(exemplars.size());
  for (const Exemplar& exemplar : exemplars) own.push_back(own_steps(exemplar));
  std::map<std::array<std::uint16_t, 4>, double> strangers;  // by exemplar and class of both
  SeamSums within;
  SeamSums between;
  const auto look = [&](int x, int y, int dx, int dy) {
    if (!matches.contains(x + dx, y + dy)) return;
    const Match& a = matches(x, y);
    const Match& b = matches(x + dx, y + dy);
    if (a.exemplar == Match::none || b.exemplar == Match::none) return;
    if (a.exemplar == b.exemplar && b.x - a.x == dx && b.y - a.y == dy)
      return;  // copied together: not a seam
    if (!depth_m.empty()) {
      const float near = std::min(depth_m(x, y), depth_m(x + dx, y + dy));
      const float far = std::max(depth_m(x, y), depth_m(x + dx, y + dy));
      if (near != far && far > depth_ratio * near) return;
    }
    const Exemplar& from = exemplars[a.exemplar];
    const Exemplar& to = exemplars[b.exemplar];
    const std::uint8_t label = from.guides.label(a.x, a.y);
    const std::uint8_t other = to.guides.label(b.x, b.y);
    const int step = step_between(from.picture(a.x, a.y), to.picture(b.x, b.y));
    SeamSums& sums = a.exemplar == b.exemplar ? within : between;
    sums.all.add(step);
    double usual = mean_of_both(own[a.exemplar].of(label, other), own[b.exemplar].of(label, other));
    if (usual < 0.0 && label != other) {
      const auto [known, is_new] =
          strangers.try_emplace({a.exemplar, label, b.exemplar, other}, 0.0);
      if (is_new) known->second = step_of_strangers(own[a.exemplar], label, own[b.exemplar], other);
      usual = known->second;
    }
    if (usual < 0.0) return;
    sums.compared.add(step);
    sums.usual += usual;
  };
  for (int y = 0; y < matches.height(); ++y) {
    for (int x = 0; x < matches.width(); ++x) {
      look(x, y, 1, 0);
      look(x, y, 0, 1);
    }
  }
  return {within.visibility(), between.visibility()};
}

}  // namespace belvedere
