#include "texture/composite/make_label_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/math_exact.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr int phases = 4;  // distance between pixels that are updated together, in rows and columns

// Added to shares before logarithms, so that shares of 0 have one: about a pixel of a map of 100 ×
// 100.
constexpr double pair_floor = 1e-4;
constexpr double ring_floor = 2e-5;
constexpr double profile_floor = .01;

struct PairTerm {
  LabelOffset offset;   // in pixels of the lattice
  const float* wanted;  // labels × labels
  std::vector<float> potential;
};

struct RingTerm {
  int step;  // in pixels of the lattice
  const float* wanted;
  std::vector<float> potential;
  Grid<std::uint8_t> patterns;  // of the current map, where the whole ring is inside it

  bool whole(int x, int y) const {
    return x >= step && y >= step && x + step < patterns.width() && y + step < patterns.height();
  }
};

// The field of one lattice.
struct Field {
  int labels = 0;
  std::vector<PairTerm> pairs;
  std::vector<RingTerm> rings;
  std::vector<float> heights;            // potentials of labels by strips; empty: without layout
  std::vector<StripPosition> positions;  // of each row
};

LabelCounts count_patterns(const RingTerm& term) {
  LabelCounts counts(ring_patterns, 0U);
  for (int y = term.step; y + term.step < term.patterns.height(); ++y)
    for (int x = term.step; x + term.step < term.patterns.width(); ++x)
      ++counts[term.patterns(x, y)];
  return counts;
}

template <class Count>
void correct(std::vector<float>& potential, const float* wanted, const Count* counts, std::size_t n,
             double floor, double rate) {
  double total = 0.0;
  for (std::size_t i = 0; i < n; ++i) total += static_cast<double>(counts[i]);
  if (total == 0.0) return;
  for (std::size_t i = 0; i < n; ++i)
    potential[i] +=
        static_cast<float>(rate * exact::log((static_cast<double>(counts[i]) / total + floor) /
                                             (static_cast<double>(wanted[i]) + floor)));
}

// Raises the potentials of what is too frequent.
void correct(Field& field, const LabelMapModel& model, const Grid<std::uint8_t>& map, int step,
             int height, double rate) {
  const auto n = static_cast<std::size_t>(field.labels);
  parallel_ranges(field.pairs.size() + field.rings.size(), std::size_t{1},
                  [&](std::size_t begin, std::size_t end) {
                    for (std::size_t k = begin; k != end; ++k) {
                      if (k < field.pairs.size()) {
                        PairTerm& term = field.pairs[k];
                        correct(term.potential, term.wanted,
                                count_label_pairs(map, field.labels, term.offset).data(), n * n,
                                pair_floor, rate);
                      } else {
                        RingTerm& term = field.rings[k - field.pairs.size()];
                        correct(term.potential, term.wanted, count_patterns(term).data(),
                                ring_patterns, ring_floor, rate);
                      }
                    }
                  });
  if (field.heights.empty()) return;
  const std::vector<std::uint64_t> profile = count_profile(map, field.labels, step, height);
  std::vector<float> strip(n);
  for (std::size_t z = 0; z < label_strips; ++z) {
    const auto first = field.heights.begin() + static_cast<std::ptrdiff_t>(z * n);
    std::copy_n(first, n, strip.begin());
    correct(strip, model.profile.data() + z * n, profile.data() + z * n, n, profile_floor, rate);
    std::copy(strip.begin(), strip.end(), first);
  }
}

// The step opposite to step k of a ring.
constexpr std::size_t back(std::size_t k) { return 7 - k; }

void find_patterns(Field& field, const Grid<std::uint8_t>& map) {
  for (RingTerm& term : field.rings) {
    term.patterns = Grid<std::uint8_t>(map.width(), map.height());
    parallel_rows(map.height(), [&](int y) {
      for (int x = 0; x < map.width(); ++x)
        if (term.whole(x, y))
          term.patterns(x, y) = static_cast<std::uint8_t>(ring_pattern(map, x, y, term.step));
    });
  }
}

void change(Grid<std::uint8_t>& map, Field& field, int x, int y, std::uint8_t to) {
  map(x, y) = to;
  for (RingTerm& term : field.rings) {
    if (term.whole(x, y))
      term.patterns(x, y) = static_cast<std::uint8_t>(ring_pattern(map, x, y, term.step));
    for (std::size_t k = 0; k < ring_steps.size(); ++k) {
      const int cx = x + term.step * ring_steps[k].dx;
      const int cy = y + term.step * ring_steps[k].dy;
      if (!term.whole(cx, cy)) continue;
      const auto bit = static_cast<std::uint8_t>(1U << back(k));
      std::uint8_t& pattern = term.patterns(cx, cy);
      pattern = static_cast<std::uint8_t>(map(cx, cy) == to ? pattern | bit : pattern & ~bit);
    }
  }
}

// Cost of pixel (x, y) becoming `to`.
float cost(const Field& field, const Grid<std::uint8_t>& map, int x, int y, std::uint8_t to) {
  const std::uint8_t from = map(x, y);
  const auto n = static_cast<std::size_t>(field.labels);
  float sum = 0.F;
  if (!field.heights.empty()) {
    const StripPosition& position = field.positions[static_cast<std::size_t>(y)];
    const float* upper = field.heights.data() + static_cast<std::size_t>(position.upper) * n;
    const float lower = static_cast<float>(position.lower_256) / 256.F;
    sum += (1.F - lower) * (upper[to] - upper[from]) + lower * (upper[n + to] - upper[n + from]);
  }
  for (const PairTerm& term : field.pairs) {
    const float* v = term.potential.data();
    const auto [dx, dy] = term.offset;
    if (map.contains(x + dx, y + dy)) {
      const std::uint8_t head = map(x + dx, y + dy);
      sum += v[to * n + head] - v[from * n + head];
    }
    if (map.contains(x - dx, y - dy)) {
      const std::uint8_t tail = map(x - dx, y - dy);
      sum += v[tail * n + to] - v[tail * n + from];
    }
  }
  for (const RingTerm& term : field.rings) {
    const int s = term.step;
    const float* v = term.potential.data();
    if (term.whole(x, y)) {
      int after = 0;
      for (std::size_t k = 0; k < ring_steps.size(); ++k)
        after |= map(x + s * ring_steps[k].dx, y + s * ring_steps[k].dy) == to ? 1 << k : 0;
      sum += v[after] - v[term.patterns(x, y)];
    }
    for (std::size_t k = 0; k < ring_steps.size(); ++k) {
      const int cx = x + s * ring_steps[k].dx;
      const int cy = y + s * ring_steps[k].dy;
      if (!term.whole(cx, cy)) continue;
      const std::uint8_t centre = map(cx, cy);
      if (centre != from && centre != to) continue;
      const int pattern = term.patterns(cx, cy);
      sum += v[pattern ^ (1 << back(k))] - v[pattern];
    }
  }
  return sum;
}

struct Sweep {
  std::uint64_t seed = 0;
  float coldness = 1.F;  // factor on costs
  float anywhere = .1F;  // share of proposals with any label instead of a neighbour's
};

// The pixels of each of sixteen phases decide by the current map, then change together.
void sweep(Grid<std::uint8_t>& map, Field& field, const Sweep& by) {
  std::vector<std::uint8_t> next(map.size());
  for (int phase = 0; phase < phases * phases; ++phase) {
    const int x0 = (phase * 5) % phases;
    const int y0 = phase / phases;
    const int rows = std::max(0, (map.height() - y0 + phases - 1) / phases);
    const auto decide = [&](int x, int y) {
      const std::uint8_t own = map(x, y);
      std::uint8_t& to = next[map.index(x, y)];
      to = own;
      const std::uint64_t bits = random_bits(by.seed, x, y, 0);
      const float kind = static_cast<float>(bits & 0xffffU) / 65536.F;
      const auto which = static_cast<std::uint32_t>(bits >> 32);
      std::uint8_t other = 0;
      if (kind < by.anywhere) {
        other = static_cast<std::uint8_t>(
            (static_cast<std::uint64_t>(which) * static_cast<std::uint64_t>(field.labels)) >> 32);
      } else {
        const LabelOffset& step = ring_steps[which >> 29];
        other = map.clamped(x + step.dx, y + step.dy);
      }
      if (other == own) return;
      const float rise = by.coldness * cost(field, map, x, y, other);
      if (rise <= 0.F || random_uniform(by.seed, x, y, 1) < exact::exp(-static_cast<double>(rise)))
        to = other;
    };
    parallel_ranges(rows, 4, [&](int begin, int end) {
      for (int r = begin; r != end; ++r)
        for (int x = x0; x < map.width(); x += phases) decide(x, y0 + phases * r);
    });
    // Single-threaded: rings of pixels that change together share centres.
    for (int y = y0; y < map.height(); y += phases)
      for (int x = x0; x < map.width(); x += phases)
        if (const std::uint8_t to = next[map.index(x, y)]; to != map(x, y))
          change(map, field, x, y, to);
  }
}

Field make_field(const LabelMapModel& model, int scale, const LabelMapParameters& parameters) {
  Field field{.labels = model.labels, .pairs{}, .rings{}, .heights{}, .positions{}};
  const auto n = static_cast<std::size_t>(model.labels);
  for (int s = scale; s < label_scales; ++s) {
    const int step = 1 << (s - scale);
    for (int k = 0; k < label_offsets; ++k) {
      const LabelOffset& offset = label_steps[static_cast<std::size_t>(k)];
      field.pairs.push_back({{offset.dx * step, offset.dy * step},
                             model.pairs.data() + model.pair_table(s, k),
                             std::vector<float>(n * n, 0.F)});
    }
    if (parameters.rings)
      field.rings.push_back({step,
                             model.rings.data() + static_cast<std::size_t>(s) * ring_patterns,
                             std::vector<float>(ring_patterns, 0.F),
                             {}});
  }
  return field;
}

// Labels drawn independently per pixel from the profile of their strips.
Grid<std::uint8_t> first_map(const LabelMapModel& model, int width, int height, int step,
                             int map_height, bool layout, std::uint64_t seed) {
  Grid<std::uint8_t> map(width, height);
  const auto n = static_cast<std::size_t>(model.labels);
  std::vector<float> mean(n, 0.F);
  for (std::size_t i = 0; i < model.profile.size(); ++i)
    mean[i % n] += model.profile[i] / label_strips;
  for (int y = 0; y < height; ++y) {
    const StripPosition position = strip_position(std::min(y * step, map_height - 1), map_height);
    const float lower = static_cast<float>(position.lower_256) / 256.F;
    const float* strip = model.profile.data() + static_cast<std::size_t>(position.upper) * n;
    for (int x = 0; x < width; ++x) {
      auto left = static_cast<float>(random_uniform(seed, x, y));
      std::uint8_t label = 0;
      for (std::size_t k = 0; k + 1 < n; ++k) {
        left -= layout ? (1.F - lower) * strip[k] + lower * strip[n + k] : mean[k];
        if (left < 0.F) break;
        ++label;
      }
      map(x, y) = label;
    }
  }
  return map;
}

}  // namespace

Grid<std::uint8_t> make_label_map(const LabelMapModel& model, int width, int height,
                                  const LabelMapParameters& parameters, Progress& progress) {
  constexpr std::array<int, label_scales> sweeps = {40, 60, 80, 160,
                                                    300};  // of each scale, the finest first
  int finest = 0;
  const auto pixels_at = [&](int scale) {
    return (std::int64_t{width} >> scale) * (std::int64_t{height} >> scale);
  };
  while (finest < label_scales - 1 && pixels_at(finest) > parameters.finest_pixels) ++finest;
  check_texture_size(width >> finest, height >> finest);
  check_memory(fmt::format("a map of {} × {} labels", width, height),
               2.0 * static_cast<double>(width) * height);
  const LabelMapModel wanted = at_size(model, width, height);
  Grid<std::uint8_t> map;
  progress.begin("making a label map", static_cast<double>(width) * height * 4.0 / 3.0);
  for (int scale = label_scales - 1; scale >= finest; --scale) {
    const int step = 1 << scale;
    const int w = (width + step - 1) / step;
    const int h = (height + step - 1) / step;
    const auto part = [&](int n) {
      return stream_seed(parameters.seed, Stream::label_maps,
                         static_cast<std::uint64_t>(10000 * scale + n));
    };
    if (map.empty()) {
      map = first_map(model, w, h, step, height, parameters.layout, part(0));
    } else {
      Grid<std::uint8_t> finer(w, h);
      for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) finer(x, y) = map(x / 2, y / 2);
      map = std::move(finer);
    }
    Field field = make_field(wanted, scale, parameters);
    if (parameters.layout) {
      field.heights.assign(model.profile.size(), 0.F);
      for (int y = 0; y < h; ++y)
        field.positions.push_back(strip_position(std::min(y * step, height - 1), height));
    }
    find_patterns(field, map);
    const int count =
        std::max(8, static_cast<int>(parameters.effort * sweeps[static_cast<std::size_t>(scale)]));
    for (int t = 0; t < count; ++t) {
      correct(field, model, map, step, height, .3 * std::min(1.0, 2.0 * (count - t) / count));
      sweep(map, field,
            {.seed = part(1 + t), .coldness = 1.F, .anywhere = scale > 2 ? .15F : .03F});
    }
    progress.advance(static_cast<double>(w) * h);
  }
  if (finest == 0) return map;
  Grid<std::uint8_t> whole(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) whole(x, y) = map(x >> finest, y >> finest);
  return whole;
}

}  // namespace belvedere
