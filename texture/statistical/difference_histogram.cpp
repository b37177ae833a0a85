#include "texture/statistical/difference_histogram.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace belvedere {

DifferenceHistogram count_differences(const BandPicture& picture, const BandSpace& bands,
                                      const CliqueType& type) {
  const DifferenceRange range = difference_range(bands, type);
  const float to_bin = static_cast<float>(difference_bins) / (range.high - range.low);
  const bool single = type.single();
  // Neighbours often fall into one bin: four alternating tables avoid waiting for the processor's
  // own last write.
  std::array<std::array<std::uint32_t, difference_bins>, 4> tables{};
  DifferenceHistogram out;
  clique_rows(picture.width(), picture.height(), type, 0, picture.height(),
              [&](int ty, int hy, int tx, int hx, int cliques) {
                const float* head = picture.band(type.head).row(hy) + hx;
                const float* tail = picture.band(type.tail).row(ty) + tx;
                const std::uint8_t* head_state = picture.states.row(hy) + hx;
                const std::uint8_t* tail_state = picture.states.row(ty) + tx;
                for (int x = 0; x < cliques; ++x) {
                  if ((head_state[x] & tail_state[x] & pixel_counts) == 0 ||
                      ((head_state[x] | tail_state[x]) & pixel_changes) == 0)
                    continue;
                  const float difference = single ? head[x] : head[x] - tail[x];
                  const int bin = std::clamp(static_cast<int>((difference - range.low) * to_bin), 0,
                                             difference_bins - 1);
                  ++tables[static_cast<std::size_t>(x & 3)][static_cast<std::size_t>(bin)];
                  ++out.total;
                }
              });
  for (std::size_t i = 0; i < out.counts.size(); ++i)
    out.counts[i] = tables[0][i] + tables[1][i] + tables[2][i] + tables[3][i];
  return out;
}

CliqueKnots find_knots(const DifferenceHistogram& histogram, const DifferenceRange& range) {
  int first = 0;
  while (first < difference_bins - 1 && histogram.counts[static_cast<std::size_t>(first)] == 0)
    ++first;
  int last = difference_bins;
  while (last > 1 && histogram.counts[static_cast<std::size_t>(last - 1)] == 0) --last;
  CliqueKnots knots{};
  double below = 0.0;
  int bin = 0;
  for (int k = 0; k < clique_knots; ++k) {
    const double wanted =
        static_cast<double>(clique_knot_share(k)) * static_cast<double>(histogram.total);
    const auto in = [&] {
      return static_cast<double>(histogram.counts[static_cast<std::size_t>(bin)]);
    };
    while (bin < difference_bins - 1 && below + in() < wanted) {
      below += in();
      ++bin;
    }
    double at = bin + (in() > 0.0 ? (wanted - below) / in() : 0.0);
    if (k == 0) at = first;
    if (k == clique_knots - 1) at = last;
    knots[static_cast<std::size_t>(k)] =
        range.low + static_cast<float>(at) * (range.high - range.low) / difference_bins;
  }
  return knots;
}

HistogramGroups::HistogramGroups(const DifferenceHistogram& example) {
  const std::uint64_t tail = example.total / 200;
  std::uint64_t below = 0;
  int from = 0;
  int to = difference_bins - 1;
  for (int i = 0; i < difference_bins; ++i) {
    below += example.counts[static_cast<std::size_t>(i)];
    if (below <= tail) from = i;
    if (below < example.total - tail) to = i + 1;
  }
  to = std::max(to, from + 4);
  for (int i = 0; i < difference_bins; ++i) {
    int group = 1 + (i - from) * (count - 2) / (to - from);
    if (i < from) group = 0;
    if (i >= to) group = count - 1;
    const auto at = static_cast<std::size_t>(i);
    group_[at] = static_cast<std::uint8_t>(group);
    share_[static_cast<std::size_t>(group)] += static_cast<double>(example.counts[at]);
  }
  for (double& share : share_)
    share /= static_cast<double>(std::max<std::uint64_t>(example.total, 1));
}

HistogramGroups::Distance HistogramGroups::distance(const DifferenceHistogram& histogram) const {
  std::array<double, count> in{};
  for (std::size_t i = 0; i < group_.size(); ++i)
    in[group_[i]] += static_cast<double>(histogram.counts[i]);
  Distance out;
  for (std::size_t g = 0; g < in.size(); ++g) {
    const double off =
        in[g] / static_cast<double>(std::max<std::uint64_t>(histogram.total, 1)) - share_[g];
    out.l1 += std::abs(off);
    out.l2 += off * off;
  }
  out.l2 = std::sqrt(out.l2);
  return out;
}

}  // namespace belvedere
