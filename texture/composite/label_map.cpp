#include "texture/composite/label_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

template <class Count>
void append_shares(std::vector<float>& to, const std::vector<Count>& counts, std::size_t first,
                   std::size_t n) {
  double total = 0.0;
  for (std::size_t i = 0; i < n; ++i) total += static_cast<double>(counts[first + i]);
  for (std::size_t i = 0; i < n; ++i)
    to.push_back(total > 0.0 ? static_cast<float>(static_cast<double>(counts[first + i]) / total)
                             : 1.F / static_cast<float>(n));
}

// Mean over tables of n values.
double l1_of(const std::vector<float>& a, const std::vector<float>& b, std::size_t n) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
  return sum * static_cast<double>(n) / static_cast<double>(std::max<std::size_t>(a.size(), 1));
}

LabelMapModel statistics_of(const Grid<std::uint8_t>& labels, int count) {
  LabelMapModel model{.labels = count,
                      .crop_width = labels.width(),
                      .crop_height = labels.height(),
                      .pairs{},
                      .rings{},
                      .profile{}};
  const auto n = static_cast<std::size_t>(count);
  std::vector<LabelCounts> pairs(label_scales * label_offsets);
  std::vector<LabelCounts> rings(label_scales);
  parallel_ranges(
      pairs.size() + rings.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k != end; ++k) {
          const int scale =
              static_cast<int>(k < pairs.size() ? k / label_offsets : k - pairs.size());
          const LabelOffset& step = label_steps[k % label_offsets];
          if (k < pairs.size())
            pairs[k] =
                count_label_pairs(labels, count, {step.dx * (1 << scale), step.dy * (1 << scale)});
          else
            rings[k - pairs.size()] = count_rings(labels, 1 << scale);
        }
      });
  for (const LabelCounts& table : pairs) append_shares(model.pairs, table, 0, n * n);
  for (const LabelCounts& table : rings) append_shares(model.rings, table, 0, ring_patterns);
  const std::vector<std::uint64_t> profile = count_profile(labels, count, 1, labels.height());
  for (std::size_t strip = 0; strip < label_strips; ++strip)
    append_shares(model.profile, profile, strip * n, n);
  return model;
}

}  // namespace

LabelCounts count_label_pairs(const Grid<std::uint8_t>& labels, int count, LabelOffset offset) {
  LabelCounts counts(static_cast<std::size_t>(count) * static_cast<std::size_t>(count), 0U);
  const int first = std::max(0, -offset.dx);
  const int last = labels.width() - std::max(0, offset.dx);
  for (int y = 0; y + offset.dy < labels.height(); ++y) {
    const std::uint8_t* tail = labels.row(y);
    const std::uint8_t* head = labels.row(y + offset.dy) + offset.dx;
    for (int x = first; x < last; ++x)
      ++counts[static_cast<std::size_t>(tail[x]) * static_cast<std::size_t>(count) + head[x]];
  }
  return counts;
}

LabelCounts count_rings(const Grid<std::uint8_t>& labels, int step) {
  LabelCounts counts(ring_patterns, 0U);
  for (int y = step; y + step < labels.height(); ++y)
    for (int x = step; x + step < labels.width(); ++x)
      ++counts[static_cast<std::size_t>(ring_pattern(labels, x, y, step))];
  return counts;
}

StripPosition strip_position(int y, int height) {
  // Centres of strips are at (k + ½) / 16 of the height; in 256ths of a strip, from the first
  // centre on.
  const std::int64_t at = (std::int64_t{2} * y + 1) * label_strips * 128 / height - 128;
  const std::int64_t held = std::clamp<std::int64_t>(at, 0, (label_strips - 1) * 256);
  const int upper = std::min(static_cast<int>(held / 256), label_strips - 2);
  return {upper, static_cast<int>(held - 256 * upper)};
}

std::vector<std::uint64_t> count_profile(const Grid<std::uint8_t>& labels, int count, int step,
                                         int height) {
  const auto n = static_cast<std::size_t>(count);
  std::vector<std::uint64_t> counts(label_strips * n, 0U);
  std::vector<std::uint64_t> row(n);
  for (int y = 0; y < labels.height(); ++y) {
    std::fill(row.begin(), row.end(), 0U);
    for (int x = 0; x < labels.width(); ++x) ++row[labels(x, y)];
    const StripPosition position = strip_position(std::min(y * step, height - 1), height);
    const auto upper = static_cast<std::size_t>(position.upper) * n;
    for (std::size_t k = 0; k < n; ++k) {
      counts[upper + k] += row[k] * static_cast<std::uint64_t>(256 - position.lower_256);
      counts[upper + n + k] += row[k] * static_cast<std::uint64_t>(position.lower_256);
    }
  }
  return counts;
}

LabelMapModel learn_label_map(const Grid<std::uint8_t>& labels, int count) {
  if (count < 2 || count > max_labels)
    throw Error(ErrorKind::input, "the label map",
                fmt::format("{} label{}", count, count == 1 ? "" : "s"),
                fmt::format("2 to {}", max_labels));
  if (std::any_of(labels.begin(), labels.end(),
                  [count](std::uint8_t label) { return label >= count; }))
    throw Error(ErrorKind::bug, "learn_label_map", "a label above the count");
  return statistics_of(labels, count);
}

LabelMapModel at_size(const LabelMapModel& model, int width, int height) {
  LabelMapModel out = model;
  const auto n = static_cast<std::size_t>(model.labels);
  const double across = static_cast<double>(model.crop_width) / width;
  const double down = static_cast<double>(model.crop_height) / height;
  for (int scale = 0; scale < label_scales; ++scale) {
    for (int offset = 0; offset < label_offsets; ++offset) {
      float* table = out.pairs.data() + model.pair_table(scale, offset);
      const double keep =
          std::min(label_steps[static_cast<std::size_t>(offset)].dy > 0 ? down : across, 2.0);
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = a + 1; b < n; ++b) {
          float& over = table[a * n + b];
          float& under = table[b * n + a];
          float& more = over > under ? over : under;
          const float freed =
              static_cast<float>((1.0 - keep) * static_cast<double>(more - std::min(over, under)));
          // Moved to pairs within the two labels; where a smaller map would need more, limited so
          // that no share is negative.
          const float moved = std::max(freed, -2.F * std::min(table[a * n + a], table[b * n + b]));
          more -= moved;
          table[a * n + a] += .5F * moved;
          table[b * n + b] += .5F * moved;
        }
    }
  }
  const std::array<double, label_scales> before = border_shares(model);
  const std::array<double, label_scales> after = border_shares(out);
  for (std::size_t scale = 0; scale < label_scales; ++scale) {
    if (before[scale] <= 0.0) continue;
    const auto part = static_cast<float>(after[scale] / before[scale]);
    float* rings = out.rings.data() + scale * ring_patterns;
    float* all_alike = rings + ring_patterns - 1;
    const float border = std::min(1.F, (1.F - *all_alike) * part);
    for (float* r = rings; r != all_alike; ++r)
      *r *= *all_alike < 1.F ? border / (1.F - *all_alike) : 0.F;
    *all_alike = 1.F - border;
  }
  return out;
}

std::array<double, label_scales> border_shares(const LabelMapModel& model) {
  std::array<double, label_scales> shares{};
  const auto n = static_cast<std::size_t>(model.labels);
  for (int scale = 0; scale < label_scales; ++scale)
    for (int offset = 0; offset < 2; ++offset) {
      const float* table = model.pairs.data() + model.pair_table(scale, offset);
      double alike = 0.0;
      for (std::size_t a = 0; a < n; ++a) alike += static_cast<double>(table[a * n + a]);
      shares[static_cast<std::size_t>(scale)] += .5 * (1.0 - alike);
    }
  return shares;
}

LabelMapFigures label_map_figures(const LabelMapModel& model, const Grid<std::uint8_t>& labels) {
  const LabelMapModel made = statistics_of(labels, model.labels);
  const auto n = static_cast<std::size_t>(model.labels);
  LabelMapFigures figures;
  figures.pairs = l1_of(model.pairs, made.pairs, n * n);
  const LabelMapModel sized = at_size(model, labels.width(), labels.height());
  figures.pairs_for_size = l1_of(sized.pairs, made.pairs, n * n);
  figures.rings = l1_of(sized.rings, made.rings, ring_patterns);
  figures.profile = l1_of(model.profile, made.profile, n);
  figures.borders = border_shares(made);
  return figures;
}

}  // namespace belvedere
