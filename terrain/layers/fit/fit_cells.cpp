#include "terrain/layers/fit/fit_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {

FitCells select_cells(const FitCells& cells, std::span<const std::uint32_t> indices) {
  FitCells selected{cells.classes, std::vector<std::vector<std::uint8_t>>(cells.inputs.size()), {}};
  const auto pick = [&](const std::vector<std::uint8_t>& from) {
    std::vector<std::uint8_t> to(indices.size());
    for (std::size_t i = 0; i != to.size(); ++i) to[i] = from[indices[i]];
    return to;
  };
  for (std::size_t a = 0; a != cells.inputs.size(); ++a) selected.inputs[a] = pick(cells.inputs[a]);
  selected.labels = pick(cells.labels);
  return selected;
}

std::vector<std::uint32_t> draw_labelled(std::span<const std::uint8_t> labels, std::size_t max,
                                         std::uint64_t part) {
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i != labels.size(); ++i)
    if (labels[i] != no_class) indices.push_back(static_cast<std::uint32_t>(i));
  if (indices.size() <= max) return indices;
  // Selection sampling (Knuth, "The Art of Computer Programming" 2, 3.4.2, algorithm S): exactly
  // `most`, in order, each equally likely.
  const std::uint64_t seed = stream_seed(0, Stream::layers_fit, part);
  std::vector<std::uint32_t> drawn;
  drawn.reserve(max);
  for (std::size_t i = 0; i != indices.size() && drawn.size() != max; ++i) {
    const double chance = random_uniform(seed, static_cast<std::int64_t>(i), 0);
    if (chance * static_cast<double>(indices.size() - i) < static_cast<double>(max - drawn.size()))
      drawn.push_back(indices[i]);
  }
  return drawn;
}

std::vector<std::size_t> count_labels(std::span<const std::uint8_t> labels, int classes) {
  std::vector<std::size_t> count(static_cast<std::size_t>(classes), 0);
  for (const std::uint8_t label : labels)
    if (label != no_class) ++count[label];
  return count;
}

std::vector<double> mean_shares(const ClassShares& shares, std::span<const std::uint8_t> labels) {
  std::vector<double> mean(static_cast<std::size_t>(shares.classes), 0.0);
  double cells = 0.0;
  for (std::size_t i = 0; i != labels.size(); ++i) {
    if (labels[i] == no_class) continue;
    cells += 1.0;
    for (std::size_t k = 0; k != mean.size(); ++k) mean[k] += static_cast<double>(shares.of(i)[k]);
  }
  for (double& m : mean) m /= std::max(cells, 1.0);
  return mean;
}

ClassShares mix_shares(const ClassShares& a, const ClassShares& b, double weight) {
  ClassShares mixed = a;
  const auto of_a = static_cast<float>(weight);
  const auto of_b = static_cast<float>(1.0 - weight);
  for (std::size_t i = 0; i != mixed.values.size(); ++i)
    mixed.values[i] = of_a * a.values[i] + of_b * b.values[i];
  return mixed;
}

std::vector<std::uint8_t> most_likely(const ClassShares& shares, std::span<const double> offsets) {
  std::vector<std::uint8_t> likely(shares.size());
  parallel_ranges(shares.size(), std::size_t{16384}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      const std::span<const float> of = shares.of(i);
      double best = -1.0;
      for (std::size_t k = 0; k != of.size(); ++k) {
        const double value = static_cast<double>(of[k]) * (offsets.empty() ? 1.0 : offsets[k]);
        if (value > best) {
          best = value;
          likely[i] = static_cast<std::uint8_t>(k);
        }
      }
    }
  });
  return likely;
}

std::vector<double> matching_offsets(const ClassShares& shares, std::span<const double> wanted) {
  constexpr int rounds = 60;
  constexpr double min = 1e-5;  // of the ground: bounds steps while a class covers nothing
  std::vector<double> offsets(wanted.size());
  for (std::size_t k = 0; k != offsets.size(); ++k) offsets[k] = wanted[k] > 0.0 ? 1.0 : 0.0;
  std::vector<double> best = offsets;
  double min_off = std::numeric_limits<double>::infinity();
  for (int round = 0; round != rounds; ++round) {
    const std::vector<std::size_t> count =
        count_labels(most_likely(shares, offsets), shares.classes);
    double off = 0.0;
    std::vector<double> covered(offsets.size());
    for (std::size_t k = 0; k != offsets.size(); ++k) {
      covered[k] = static_cast<double>(count[k]) /
                   static_cast<double>(std::max<std::size_t>(shares.size(), 1));
      off += std::abs(covered[k] - wanted[k]);
    }
    if (off < min_off) {
      min_off = off;
      best = offsets;
    }
    // The sensitivity of the covered area to an offset varies widely: long steps to approach, short
    // ones to converge.
    const double step = round < 15 ? 0.25 : 0.08;
    for (std::size_t k = 0; k != offsets.size(); ++k)
      offsets[k] *= exact::pow((wanted[k] + min) / (covered[k] + min), step);
  }
  return best;
}

}  // namespace belvedere
