#include "texture/synthesis/synth_lists.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/memory/zeroed_memory.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere::synth {

ListKeys choose_list_keys(const std::vector<GuideRole>& guides) {
  return {!guides.empty(), guides.size() > 1 && guides[1].weight_q4 * 8 >= guides[0].weight_q4};
}

namespace {

// Counts of one class by bucket and value, as cumulative sums over both: any window in four
// look-ups.
class WindowCounts {
 public:
  explicit WindowCounts(int buckets) : sums_(static_cast<std::size_t>(buckets + 1) * 257, 0) {}
  std::int64_t& at(int bucket, int value) {
    return sums_[static_cast<std::size_t>(bucket) * 257 + static_cast<std::size_t>(value)];
  }
  void add(int bucket, int value, std::int64_t count) { at(bucket + 1, value + 1) += count; }
  void sum_up(int buckets) {
    for (int b = 1; b <= buckets; ++b) {
      for (int v = 1; v <= 256; ++v) at(b, v) += at(b, v - 1);
    }
    for (int b = 1; b <= buckets; ++b) {
      for (int v = 0; v <= 256; ++v) at(b, v) += at(b - 1, v);
    }
  }
  // Half open in both.
  std::int64_t count(int b0, int b1, int v0, int v1) {
    return at(b1, v1) - at(b0, v1) - at(b1, v0) + at(b0, v0);
  }

 private:
  std::vector<std::int64_t> sums_;
};

// Sections of the sequence through the exemplars; a table of 257 numbers per class and bucket each.
constexpr std::size_t stretches = 16;

// A permutation of texels in steps of .618 of their number.
struct GoldenRatioSequence {
  explicit GoldenRatioSequence(std::uint64_t texels)
      : count(texels), step(texels * 618 / 1000 | 1) {
    while (std::gcd(step, count) != 1) step += 2;
  }
  // The texel at a position of the sequence, which is cyclic.
  std::uint64_t texel(std::uint64_t position) const {
    return position % count * (step % count) % count;
  }
  std::uint64_t after(std::uint64_t texel) const {
    return texel + step < count ? texel + step : texel + step - count;
  }
  std::uint64_t count;
  std::uint64_t step;
};

}  // namespace

TexelDemand count_texel_demand(const Plane& target, int classes,
                               const std::vector<GuideRole>& guides) {
  TexelDemand demand;
  demand.keys = choose_list_keys(guides);
  const std::size_t buckets = static_cast<std::size_t>(demand.keys.buckets());
  demand.counts.assign(static_cast<std::size_t>(classes) * buckets * 256, 0);
  target.for_each([&](std::uint32_t at) {
    const std::uint32_t c = class_of(target.words[at]);
    if (c == no_class) return;
    const std::uint8_t* values = target.guides_at(at);
    const std::size_t bucket = demand.keys.bucketed ? values[1] / ListKeys::bucket_width : 0U;
    ++demand.counts[(c * buckets + bucket) * 256 + (demand.keys.sorted ? values[0] : 0U)];
  });
  return demand;
}

PickLists::PickLists(const Plane& exemplars, const TexelDemand& demand, int classes,
                     const std::vector<GuideRole>& guides, int minimum,
                     const std::vector<Surroundings>& around)
    : keys_(demand.keys) {
  const int buckets = keys_.buckets();
  const std::size_t cells = static_cast<std::size_t>(classes) * static_cast<std::size_t>(buckets);

  // A counting sort of texels visited in golden-ratio steps, so that consecutive list entries are
  // far apart in the picture. In fixed sections: each counts its texels, and then knows where they
  // go after those of the earlier sections.
  const GoldenRatioSequence way(exemplars.words.size());
  const std::size_t each = way.count / stretches + 1;
  const std::size_t kinds = cells * 257;
  const auto kind_of = [&](std::uint32_t c, const std::uint8_t* values) {
    return cell(c, bucket_of(values)) * 257 + static_cast<std::size_t>(value_of(values));
  };
  const std::size_t guide_count = static_cast<std::size_t>(exemplars.guide_count);
  // Texels of an exemplar that lacks a guide of the order stand where a random request of their
  // class does, so that every window contains its share of them.
  std::vector<std::uint64_t> asked;  // sums of the requests before each cell and value
  if (!exemplars.known.empty()) {
    asked.assign(1, 0);
    for (const std::uint32_t count : demand.counts) asked.push_back(asked.back() + count);
  }
  const auto keys_of = [&](std::uint32_t here, std::uint32_t c, const std::uint8_t* values) {
    std::array<std::uint8_t, 2> keys{values[0], values[1]};
    if (asked.empty()) return keys;
    const int part = exemplars.part_of(here);
    const bool value_known = !keys_.sorted || exemplars.knows(part, 0);
    const bool bucket_known = !keys_.bucketed || exemplars.knows(part, 1);
    const auto first = asked.begin() + static_cast<std::ptrdiff_t>(cell(c, 0) * 256);
    const auto last = first + static_cast<std::ptrdiff_t>(buckets) * 256;
    if ((value_known && bucket_known) || *first == *last) return keys;
    const auto place = static_cast<std::size_t>(
        std::upper_bound(first, last, *first + mix_bits(here) % (*last - *first)) - first - 1);
    if (!value_known) keys[0] = static_cast<std::uint8_t>(place % 256);
    if (!bucket_known) keys[1] = static_cast<std::uint8_t>(place / 256 * ListKeys::bucket_width);
    return keys;
  };
  // Calls f(texel, class, guides) along a section. Each step goes to an uncached position, so they
  // are prefetched some steps ahead.
  const auto go = [&](std::size_t stretch, auto&& f) {
    constexpr std::uint64_t fetch_ahead = 16;
    const std::uint64_t end = std::min(way.count, (stretch + 1) * each);
    std::uint64_t here = way.texel(stretch * each);
    std::uint64_t ahead = way.texel(stretch * each + fetch_ahead);
    for (std::uint64_t i = stretch * each; i < end;
         ++i, here = way.after(here), ahead = way.after(ahead)) {
      __builtin_prefetch(exemplars.words.data() + ahead);
      __builtin_prefetch(exemplars.guides.data() + ahead * guide_count);
      const std::uint32_t c = class_of(exemplars.words[here]);
      if (c != no_class)
        f(static_cast<std::uint32_t>(here), c,
          exemplars.guides_at(static_cast<std::uint32_t>(here)));
    }
  };
  std::vector<std::vector<std::uint32_t>> next(stretches);
  parallel_rows(static_cast<int>(stretches), [&](int s) {
    std::vector<std::uint32_t>& met = next[static_cast<std::size_t>(s)];
    met.assign(kinds, 0);
    go(static_cast<std::size_t>(s),
       [&](std::uint32_t here, std::uint32_t c, const std::uint8_t* values) {
         ++met[kind_of(c, keys_of(here, c, values).data())];
       });
  });
  std::vector<std::uint32_t> counts(kinds, 0);
  start_.assign(kinds, 0);
  std::uint32_t total = 0;
  for (std::size_t i = 0; i < kinds; ++i) {
    start_[i] = total;
    for (std::vector<std::uint32_t>& met : next) total += std::exchange(met[i], total);
    counts[i] = total - start_[i];
  }
  entry_words_ = 1 + (Entry::guides_from + guide_count + 3) / 4;
  assign_in_large_pages(entries_, total * entry_words_ + 2,
                        0U);  // eight guides may be read from the last one, too
  parallel_rows(static_cast<int>(stretches), [&](int s) {
    std::vector<std::uint32_t>& position = next[static_cast<std::size_t>(s)];
    go(static_cast<std::size_t>(s),
       [&](std::uint32_t here, std::uint32_t c, const std::uint8_t* values) {
         const std::size_t nth = position[kind_of(c, keys_of(here, c, values).data())]++;
         std::uint32_t* entry = entries_.data() + nth * entry_words_;
         entry[0] = here;
         std::uint8_t* bytes = reinterpret_cast<std::uint8_t*>(entry + 1);
         if (!around.empty()) {
           bytes[0] = around[here].others;
           bytes[1] = around[here].commonest;
         }
         const Greys greys = greys_around(exemplars, here);
         std::copy(greys.values.begin(), greys.values.end(), bytes + 2);
         std::copy(values, values + guide_count, bytes + Entry::guides_from);
       });
  });

  windows_.assign(cells * 256, PickWindow{255, static_cast<std::uint8_t>(buckets - 1)});
  const std::int64_t value_weight = keys_.sorted ? guides[0].weight_q4 : 0;
  const std::int64_t bucket_weight = keys_.bucketed ? guides[1].weight_q4 : 0;
  parallel_rows(classes, [&](int c) {
    const std::uint32_t label_class = static_cast<std::uint32_t>(c);
    WindowCounts sources(buckets);
    WindowCounts pixels(buckets);
    std::int64_t all_pixels = 0;
    for (int b = 0; b < buckets; ++b) {
      for (int v = 0; v < 256; ++v) {
        sources.add(b, v, counts[cell(label_class, b) * 257 + static_cast<std::size_t>(v)]);
        const std::int64_t asking =
            demand.pixels_each *
            demand.counts[cell(label_class, b) * 256 + static_cast<std::size_t>(v)];
        pixels.add(b, v, asking);
        all_pixels += asking;
      }
    }
    sources.sum_up(buckets);
    pixels.sum_up(buckets);
    // Uses of a texel within a window, in 256ths: max(4, 1.5 × pixels of the class per texel of
    // it).
    const std::int64_t all_sources = std::max<std::int64_t>(1, texel_count(label_class));
    const std::int64_t uses_q8 =
        std::clamp<std::int64_t>(384 * all_pixels / all_sources, 1024, 1LL << 31);
    const auto wide_enough = [&](int b0, int b1, int v0, int v1) {
      const std::int64_t texels = sources.count(b0, b1, v0, v1);
      return texels >= minimum && texels * uses_q8 >= pixels.count(b0, b1, v0, v1) * 256;
    };
    for (int b = 0; b < buckets; ++b) {
      for (int v = 0; v < 256; ++v) {
        if (demand.complete &&
            demand.counts[cell(label_class, b) * 256 + static_cast<std::size_t>(v)] == 0)
          continue;
        // The window with the smallest cost of guides at its edge, over both guides.
        std::int64_t best = INT64_MAX;
        for (int s = 0; s < buckets; ++s) {
          const std::int64_t off = static_cast<std::int64_t>(s) * ListKeys::bucket_width;
          if (bucket_weight * off * off >= best) break;
          for (int t = 1; t <= 256; t += std::max(1, t / 16)) {
            const std::int64_t cost = bucket_weight * off * off + value_weight * (t - 1) * (t - 1);
            if (cost >= best) break;
            if (wide_enough(std::max(0, b - s), std::min(buckets, b + s + 1), std::max(0, v - t),
                            std::min(256, v + t + 1))) {
              best = cost;
              windows_[cell(label_class, b) * 256 + static_cast<std::size_t>(v)] = {
                  static_cast<std::uint8_t>(t - 1), static_cast<std::uint8_t>(s)};
              break;
            }
          }
        }
      }
    }
  });
}

std::int64_t PickLists::texel_count(std::uint32_t label_class) const {
  const std::size_t first = cell(label_class, 0) * 257;
  const std::size_t last = cell(label_class, keys_.buckets() - 1) * 257 + 256;
  return static_cast<std::int64_t>(start_[last]) - start_[first];
}

PickWindow PickLists::window(std::uint32_t label_class, const std::uint8_t* guides) const {
  return windows_[cell(label_class, bucket_of(guides)) * 256 +
                  static_cast<std::size_t>(value_of(guides))];
}

PickRun PickLists::pick(std::uint32_t label_class, const std::uint8_t* guides, std::uint32_t random,
                        int widen) const {
  const PickWindow own = window(label_class, guides);
  const int reach_buckets = std::min(keys_.buckets(), ((own.buckets + 1) << widen) - 1);
  const int reach_values = std::min(256, (own.slack + 1) << widen);
  const int bucket = bucket_of(guides);
  const int value = value_of(guides);
  const int b0 = std::max(0, bucket - reach_buckets);
  const int b1 = std::min(keys_.buckets(), bucket + reach_buckets + 1);
  const std::size_t v0 = static_cast<std::size_t>(std::max(0, value - reach_values));
  const std::size_t v1 = static_cast<std::size_t>(std::min(256, value + reach_values + 1));
  std::uint32_t count = 0;
  for (int b = b0; b < b1; ++b)
    count += start_[cell(label_class, b) * 257 + v1] - start_[cell(label_class, b) * 257 + v0];
  if (count == 0) return {};
  std::uint32_t nth =
      static_cast<std::uint32_t>((static_cast<std::uint64_t>(random) * count) >> 32);
  for (int b = b0;; ++b) {
    const std::uint32_t first = start_[cell(label_class, b) * 257 + v0];
    const std::uint32_t here = start_[cell(label_class, b) * 257 + v1] - first;
    if (nth < here) return {first, here, nth};
    nth -= here;
  }
}

namespace {

constexpr int side = 2 * patch_radius + 1;
constexpr int quantiles = 8;
constexpr std::size_t binned_texels_per_task = 4096;  // texels a task
constexpr std::size_t luminances = 3 * 255 + 1;
constexpr std::size_t contrasts = 384;  // the deviation of values 0…765 is at most 382.5

int luminance(std::uint32_t word) {
  return static_cast<int>((word & 255U) + (word >> 8 & 255U) + (word >> 16 & 255U));
}

// Quantile of each value in a histogram, by the rank of the value's centre.
void to_quantiles(const std::int64_t* histogram, int values, std::uint8_t* quantile) {
  std::int64_t total = 0;
  for (int i = 0; i < values; ++i) total += histogram[i];
  std::int64_t below = 0;
  for (int i = 0; i < values; ++i) {
    const std::int64_t rank =
        (below + histogram[i] / 2) * quantiles / std::max<std::int64_t>(1, total);
    quantile[i] = static_cast<std::uint8_t>(std::min<std::int64_t>(quantiles - 1, rank));
    below += histogram[i];
  }
}

// Deviation of luminance over the texels of the same class in the 7 × 7 around each texel of a row,
// so that a border of classes adds no contrast; the square root of an exact integer, so it is the
// same everywhere.
void contrast_row(const Plane& plane, std::uint32_t row, int width,
                  std::vector<std::uint16_t>& out) {
  const std::size_t columns = static_cast<std::size_t>(width + side - 1);
  std::vector<int> sum(columns);
  std::vector<int> squares(columns);
  std::vector<std::uint32_t> column_class(columns);  // no_class where a column has several
  const std::uint32_t* words = plane.words.data();
  const auto at = [&](std::size_t i, int j) {
    return static_cast<std::size_t>(static_cast<std::int64_t>(row) - patch_radius +
                                    static_cast<std::int64_t>(i) +
                                    static_cast<std::int64_t>(j) * plane.stride);
  };
  for (std::size_t i = 0; i < columns; ++i) {
    column_class[i] = class_of(words[at(i, 0)]);
    for (int j = -patch_radius; j <= patch_radius; ++j) {
      const std::uint32_t word = words[at(i, j)];
      const int value = luminance(word);
      sum[i] += value;
      squares[i] += value * value;
      if (class_of(word) != column_class[i]) column_class[i] = no_class;
    }
  }
  for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
    const std::uint32_t own = class_of(words[row + x]);
    std::int64_t s = 0;
    std::int64_t s2 = 0;
    std::int64_t count = 0;
    for (std::size_t i = x; i < x + side; ++i) {
      if (column_class[i] == own) {
        s += sum[i];
        s2 += squares[i];
        count += side;
        continue;
      }
      for (int j = -patch_radius; j <= patch_radius; ++j) {
        const std::uint32_t word = words[at(i, j)];
        if (class_of(word) != own) continue;
        const int value = luminance(word);
        s += value;
        s2 += value * value;
        ++count;
      }
    }
    const std::int64_t variance = count == 0 ? 0 : (count * s2 - s * s) / (count * count);
    out[x] = static_cast<std::uint16_t>(std::sqrt(static_cast<double>(variance)));
  }
}

}  // namespace

std::vector<std::uint8_t> make_bins(const Plane& exemplars, int classes) {
  const std::size_t class_count = static_cast<std::size_t>(classes);
  std::vector<std::uint16_t> contrast(exemplars.words.size(), 0);
  for (const Plane::Part& part : exemplars.parts) {
    parallel_rows(part.height, [&](int y) {
      const std::uint32_t row = part.origin + static_cast<std::uint32_t>(y) *
                                                  static_cast<std::uint32_t>(exemplars.stride);
      std::vector<std::uint16_t> values(static_cast<std::size_t>(part.width));
      contrast_row(exemplars, row, part.width, values);
      std::copy(values.begin(), values.end(), contrast.begin() + row);
    });
  }
  std::vector<std::int64_t> by_luminance(class_count * luminances, 0);
  std::vector<std::int64_t> by_contrast(class_count * contrasts, 0);
  exemplars.for_each([&](std::uint32_t at) {
    const std::uint32_t c = class_of(exemplars.words[at]);
    if (c == no_class) return;
    ++by_luminance[c * luminances + static_cast<std::size_t>(luminance(exemplars.words[at]))];
    ++by_contrast[c * contrasts + contrast[at]];
  });
  std::vector<std::uint8_t> luminance_quantile(by_luminance.size());
  std::vector<std::uint8_t> contrast_quantile(by_contrast.size());
  for (std::size_t c = 0; c < class_count; ++c) {
    to_quantiles(&by_luminance[c * luminances], luminances, &luminance_quantile[c * luminances]);
    to_quantiles(&by_contrast[c * contrasts], contrasts, &contrast_quantile[c * contrasts]);
  }
  std::vector<std::uint8_t> bins(exemplars.words.size(), 0);
  const int bands =
      static_cast<int>((bins.size() + binned_texels_per_task - 1) / binned_texels_per_task);
  parallel_rows(bands, [&](int b) {
    for (std::size_t at = static_cast<std::size_t>(b) * binned_texels_per_task;
         at < std::min(bins.size(), static_cast<std::size_t>(b + 1) * binned_texels_per_task);
         ++at) {
      const std::uint32_t c = class_of(exemplars.words[at]);
      if (c == no_class) continue;
      const int bright = luminance_quantile[c * luminances + static_cast<std::size_t>(
                                                                 luminance(exemplars.words[at]))];
      bins[at] = static_cast<std::uint8_t>(bright * quantiles +
                                           contrast_quantile[c * contrasts + contrast[at]]);
    }
  });
  return bins;
}

std::vector<std::int32_t> bin_penalties(const std::vector<std::int32_t>& actual,
                                        const std::vector<std::int32_t>& expected,
                                        std::int32_t strength) {
  std::vector<std::int32_t> penalties(actual.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    const std::int64_t excess = (static_cast<std::int64_t>(actual[i]) - expected[i]) * 16 /
                                (static_cast<std::int64_t>(expected[i]) + 4);
    penalties[i] =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(excess, -16, 32) * strength / 16);
  }
  return penalties;
}

std::vector<std::int32_t> steer_bins(const std::vector<std::int32_t>& actual,
                                     const std::vector<std::int32_t>& expected,
                                     std::int32_t strength, std::vector<std::int32_t>& kept) {
  std::vector<std::int32_t> costs = bin_penalties(actual, expected, strength);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    kept[i] = std::clamp(kept[i] + costs[i] / 16, -2 * strength, 2 * strength);
    costs[i] += kept[i];
  }
  return costs;
}

}  // namespace belvedere::synth
