#include "texture/quality/picture_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/quality/quality_parts.h"

namespace belvedere {
namespace {

constexpr int border_squared = 16;  // at most 4 pixels

}  // namespace

Grid<std::uint8_t> border_distance_squared(const Grid<std::uint8_t>& labels) {
  constexpr int reach = 15;
  const int width = labels.width();
  const int height = labels.height();
  // First down the columns, then the minimum of column distance² + dx² along the rows.
  Grid<std::uint8_t> column(width, height, 255);
  const auto on_border = [&](int x, int y) {
    return (x > 0 && labels(x, y) != labels(x - 1, y)) ||
           (y > 0 && labels(x, y) != labels(x, y - 1));
  };
  parallel_ranges(width, 64, [&](int x0, int x1) {
    for (int x = x0; x < x1; ++x) {
      int since = reach + 1;
      for (int y = 0; y < height; ++y) {
        since = on_border(x, y) ? 0 : std::min(reach + 1, since + 1);
        column(x, y) = static_cast<std::uint8_t>(since);
      }
      since = reach + 1;
      for (int y = height - 1; y >= 0; --y) {
        since = column(x, y) == 0 ? 0 : std::min(reach + 1, since + 1);
        column(x, y) = static_cast<std::uint8_t>(std::min<int>(column(x, y), since));
      }
    }
  });
  Grid<std::uint8_t> out(width, height, 255);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      int min = 255;
      for (int i = std::max(0, x - reach); i <= std::min(width - 1, x + reach); ++i) {
        const int down = column(i, y);
        if (down <= reach) min = std::min(min, (i - x) * (i - x) + down * down);
      }
      out(x, y) = static_cast<std::uint8_t>(min);
    }
  });
  return out;
}

double mean_gradient(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels,
                     const Grid<std::uint8_t>& borders, std::uint8_t label) {
  double sum = 0.0;
  std::size_t count = 0;
  // Central differences, one-sided at the picture's edges.
  const auto slope = [](int before, int after, bool whole) {
    return (after - before) / (whole ? 2.0 : 1.0) / 3.0;
  };
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (labels(x, y) != label || borders(x, y) <= quality::inside_squared) continue;
      const double gx =
          slope(quality::sum_of(picture.clamped(x - 1, y)),
                quality::sum_of(picture.clamped(x + 1, y)), x > 0 && x + 1 < picture.width());
      const double gy =
          slope(quality::sum_of(picture.clamped(x, y - 1)),
                quality::sum_of(picture.clamped(x, y + 1)), y > 0 && y + 1 < picture.height());
      sum += exact::hypot(gx, gy);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

int stroke_tolerance(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels,
                     std::uint8_t label) {
  std::vector<std::size_t> deviations(384, 0);
  std::size_t count = 0;
  for (int y = 0; y < picture.height(); y += 3) {
    for (int x = 0; x < picture.width(); x += 3) {
      if (labels(x, y) != label) continue;
      std::int64_t s = 0;
      std::int64_t s2 = 0;
      for (int j = -3; j <= 3; ++j) {
        for (int i = -3; i <= 3; ++i) {
          const int v = quality::sum_of(picture.clamped(x + i, y + j));
          s += v;
          s2 += static_cast<std::int64_t>(v) * v;
        }
      }
      ++deviations[static_cast<std::size_t>(std::sqrt(static_cast<double>(49 * s2 - s * s)) /
                                            49.0)];
      ++count;
    }
  }
  return count == 0
             ? 0
             : static_cast<int>(quality::quantile(deviations.data(), deviations.size(), 0.5) / 2.0);
}

double stroke_run(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels,
                  const Grid<std::uint8_t>& borders, std::uint8_t label, int tolerance) {
  constexpr int directions = 16;
  constexpr int longest = 32;  // in each direction
  constexpr double pi = 3.14159265358979323846;
  std::array<std::array<std::array<int, 2>, longest + 1>, directions> steps{};
  std::array<double, directions>
      step_length{};  // length of a step along the longer axis, in pixels
  for (std::size_t d = 0; d < directions; ++d) {
    const double angle = pi * static_cast<double>(d) / directions;
    const double longer = std::max(std::abs(exact::cos(angle)), std::abs(exact::sin(angle)));
    step_length[d] = 1.0 / longer;
    for (std::size_t t = 0; t <= longest; ++t) {
      steps[d][t] = {
          static_cast<int>(std::lround(static_cast<double>(t) * exact::cos(angle) / longer)),
          static_cast<int>(std::lround(static_cast<double>(t) * exact::sin(angle) / longer))};
    }
  }
  std::vector<double> sums(static_cast<std::size_t>(picture.height()), 0.0);
  std::vector<std::size_t> counts(sums.size(), 0);
  parallel_rows((picture.height() + 2) / 3, [&](int row) {
    const int y = 3 * row;
    for (int x = 0; x < picture.width(); x += 3) {
      if (labels(x, y) != label || borders(x, y) <= quality::inside_squared) continue;
      const int here = quality::sum_of(picture(x, y));
      double best = 0.0;
      for (std::size_t d = 0; d < directions; ++d) {
        int run = 1;
        for (const int way : {1, -1}) {
          for (std::size_t t = 1; t <= longest; ++t, ++run) {
            const int i = x + way * steps[d][t][0];
            const int j = y + way * steps[d][t][1];
            if (!picture.contains(i, j) || labels(i, j) != label ||
                std::abs(quality::sum_of(picture(i, j)) - here) > tolerance)
              break;
          }
        }
        best = std::max(best, run * step_length[d]);
      }
      sums[static_cast<std::size_t>(y)] += std::min(best, 2.0 * longest + 1.0);
      ++counts[static_cast<std::size_t>(y)];
    }
  });
  const std::size_t count = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
  return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

SpeckShares speck_shares(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& borders) {
  constexpr int stands_out = 90;  // min contrast of a speck: 30 levels of grey
  std::size_t inside = 0, inside_specks = 0, border = 0, border_specks = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      std::array<int, 9> around{};
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i)
          around[3 * j + i + 4] = quality::sum_of(picture.clamped(x + i, y + j));
      }
      std::nth_element(around.begin(), around.begin() + 4, around.end());
      const bool speck = std::abs(quality::sum_of(picture(x, y)) - around[4]) > stands_out;
      if (borders(x, y) > quality::inside_squared) {
        ++inside;
        inside_specks += speck ? 1 : 0;
      } else if (borders(x, y) <= border_squared) {
        ++border;
        border_specks += speck ? 1 : 0;
      }
    }
  }
  return {inside > 0 ? static_cast<double>(inside_specks) / static_cast<double>(inside) : 0.0,
          border > 0 ? static_cast<double>(border_specks) / static_cast<double>(border) : 0.0};
}

double self_distance(const Grid<Rgb8>& picture, int samples) {
  constexpr int radius = 3;
  constexpr int far_enough = 16;
  constexpr std::array<int, 7> rows{0, -1, 1, -2, 2, -3, 3};
  const int width = picture.width();
  const int height = picture.height();
  if (width <= 2 * (radius + far_enough) || height <= 2 * (radius + far_enough)) return 0.0;
  const int step = height > 1024 ? 4 : 2;
  std::vector<double> nearest(static_cast<std::size_t>(samples), 0.0);
  const std::uint64_t key =
      stream_seed(0, Stream::patch_samples);  // the same positions in every picture of a size
  parallel_rows(samples, [&](int s) {
    const int px = radius + static_cast<int>(random_index(
                                static_cast<std::uint32_t>(width - 2 * radius), key, s, 0));
    const int py = radius + static_cast<int>(random_index(
                                static_cast<std::uint32_t>(height - 2 * radius), key, s, 1));
    int best = std::numeric_limits<int>::max();
    for (int y = radius; y < height - radius; y += step) {
      for (int x = radius; x < width - radius; x += step) {
        if (std::abs(x - px) < far_enough && std::abs(y - py) < far_enough) continue;
        int sum = 0;
        for (const int j : rows) {
          const std::uint8_t* a = picture(x - radius, y + j).data();
          const std::uint8_t* b = picture(px - radius, py + j).data();
          for (int i = 0; i < 3 * (2 * radius + 1); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
          if (sum >= best) break;
        }
        best = std::min(best, sum);
      }
    }
    nearest[static_cast<std::size_t>(s)] = std::sqrt(best / 147.0);
  });
  return std::accumulate(nearest.begin(), nearest.end(), 0.0) / samples;
}

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
