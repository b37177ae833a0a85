#include "texture/statistical/texture_figures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <unordered_set>

#include "base/grid.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/statistical/difference_histogram.h"

namespace belvedere {
namespace {

// Histogram of each pixel of the first band minus the mean of its four neighbours, over the range
// of the band.
DifferenceHistogram laplacian_histogram(const BandPicture& picture, const BandSpace& bands) {
  const float reach = bands.high[0] - bands.low[0];
  const Grid<float>& v = picture.bands[0];
  DifferenceHistogram out;
  for (int y = 1; y + 1 < v.height(); ++y) {
    for (int x = 1; x + 1 < v.width(); ++x) {
      if ((picture.states(x, y) & pixel_counts) == 0) continue;
      const float of = v(x, y) - .25F * (v(x - 1, y) + v(x + 1, y) + v(x, y - 1) + v(x, y + 1));
      const int bin = static_cast<int>((of / reach + 1.F) * difference_bins / 2.F);
      ++out.counts[static_cast<std::size_t>(std::clamp(bin, 0, difference_bins - 1))];
      ++out.total;
    }
  }
  return out;
}

// Direction of paint, by the structure tensor over a window of the first band. Flat positions are
// not counted.
struct RunHistograms {
  DifferenceHistogram coherence;  // 0 isotropic … 1 one direction: ((Jxx - Jyy)² + 4
                                  // Jxy²)^½ / (Jxx + Jyy)
  DifferenceHistogram
      direction;  // in eighths of half a turn, each position weighted by its coherence
};

RunHistograms run_histograms(const BandPicture& picture) {
  constexpr int reach = 3;
  constexpr float even = 1.F;  // mean square of slopes, in 8-bit units
  constexpr int directions = 8;
  constexpr int bins_a_direction = difference_bins / directions;
  const Grid<float>& v = picture.bands[0];
  RunHistograms out;
  for (int y = reach + 1; y + reach + 1 < v.height(); ++y) {
    for (int x = reach + 1; x + reach + 1 < v.width(); ++x) {
      if ((picture.states(x, y) & pixel_counts) == 0) continue;
      float xx = 0.F;
      float yy = 0.F;
      float xy = 0.F;
      for (int j = y - reach; j <= y + reach; ++j) {
        for (int i = x - reach; i <= x + reach; ++i) {
          const float gx = .5F * (v(i + 1, j) - v(i - 1, j));
          const float gy = .5F * (v(i, j + 1) - v(i, j - 1));
          xx += gx * gx;
          yy += gy * gy;
          xy += gx * gy;
        }
      }
      constexpr float window = (2 * reach + 1) * (2 * reach + 1);
      if (xx + yy < even * window) continue;
      const float coherence = std::sqrt((xx - yy) * (xx - yy) + 4.F * xy * xy) / (xx + yy);
      const int bin =
          std::clamp(static_cast<int>(coherence * difference_bins), 0, difference_bins - 1);
      ++out.coherence.counts[static_cast<std::size_t>(bin)];
      ++out.coherence.total;
      // Horizontal strokes are at the centre of the first direction, so that horizontal paint does
      // not fall half into the last.
      const double turn =
          exact::atan2(2.0 * static_cast<double>(xy), static_cast<double>(xx - yy)) /
              (2.0 * std::numbers::pi) +
          .5 / directions;
      const int of = static_cast<int>((turn - std::floor(turn)) * directions) % directions;
      out.direction.counts[static_cast<std::size_t>(of * bins_a_direction)] +=
          static_cast<std::uint32_t>(bin);
      out.direction.total += static_cast<std::uint32_t>(bin);
    }
  }
  return out;
}

// Mean distance of histograms over levels; levels without counts on either side are skipped.
class LevelsApart {
 public:
  void add(const DifferenceHistogram& of, const DifferenceHistogram& with) {
    if (of.total == 0 || with.total == 0) return;
    sum_ += HistogramGroups(of).distance(with).l1;
    ++compared_;
  }
  double mean() const { return sum_ / std::max(compared_, 1); }

 private:
  double sum_ = 0.0;
  int compared_ = 0;
};

// Key of a square: a 64-bit sum of its pixels, mixed row by row.
std::uint64_t square_key(const Grid<Rgb8>& picture, int x, int y, int side) {
  std::uint64_t key = 0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const Rgb8& c = picture(x + i, y + j);
      key = mix_bits(key ^ (std::uint64_t{c[0]} | std::uint64_t{c[1]} << 8 |
                            std::uint64_t{c[2]} << 16 | 1ULL << 24));
    }
  return key;
}

bool shares_square(const Grid<Rgb8>& crop, const Grid<Rgb8>& made, int side) {
  std::unordered_set<std::uint64_t> known;
  for (int y = 0; y + side <= crop.height(); ++y)
    for (int x = 0; x + side <= crop.width(); ++x) known.insert(square_key(crop, x, y, side));
  for (int y = 0; y + side <= made.height(); ++y)
    for (int x = 0; x + side <= made.width(); ++x)
      if (known.contains(square_key(made, x, y, side))) return true;
  return false;
}

}  // namespace

TextureFigures texture_figures(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                               const Grid<Rgb8>& made, const CliqueModel& model,
                               const LearnParameters& parameters) {
  const BandPyramid example = make_pyramid(to_bands(crop, model.bands, states), model.levels);
  const BandPyramid result = make_pyramid(to_bands(made, model.bands, {}), model.levels);
  TextureFigures out;
  int selected = 0;
  int held = 0;
  for (int level = 0; level <= model.levels; ++level) {
    const auto at = static_cast<std::size_t>(level);
    const std::vector<CliqueType> types = candidate_types(level, reach_at(parameters, level));
    std::vector<double> off(types.size());
    parallel_ranges(types.size(), std::size_t{8}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k != end; ++k)
        off[k] = HistogramGroups(count_differences(example[at], model.bands, types[k]))
                     .distance(count_differences(result[at], model.bands, types[k]))
                     .l1;
    });
    for (std::size_t k = 0; k < types.size(); ++k) {
      const bool in = std::any_of(model.cliques.begin(), model.cliques.end(),
                                  [&](const Clique& c) { return c.type == types[k]; });
      (in ? out.selected : out.held_out) += off[k];
      ++(in ? selected : held);
      out.worst = std::max(out.worst, off[k]);
    }
  }
  out.selected /= std::max(selected, 1);
  out.held_out /= std::max(held, 1);
  LevelsApart beyond;
  LevelsApart drawn;
  LevelsApart turned;
  for (std::size_t l = 0; l < std::min<std::size_t>(3, example.size()); ++l) {
    beyond.add(laplacian_histogram(example[l], model.bands),
               laplacian_histogram(result[l], model.bands));
    const RunHistograms of = run_histograms(example[l]);
    const RunHistograms with = run_histograms(result[l]);
    drawn.add(of.coherence, with.coherence);
    turned.add(of.direction, with.direction);
  }
  out.beyond = beyond.mean();
  out.drawn = drawn.mean();
  out.turned = turned.mean();
  return out;
}

TextureFigures halves_figures(const Grid<Rgb8>& crop, const CliqueModel& model,
                              const LearnParameters& parameters) {
  const int w = crop.width();
  const int h = crop.height();
  const auto between = [&](PixelRect one, PixelRect other) {
    return texture_figures(part_of(crop, one), {}, part_of(crop, other), model, parameters);
  };
  const TextureFigures across = between({0, 0, w / 2, h}, {w / 2, 0, w, h});
  const TextureFigures down = between({0, 0, w, h / 2}, {0, h / 2, w, h});
  return {.5 * (across.selected + down.selected), .5 * (across.held_out + down.held_out),
          std::max(across.worst, down.worst),     .5 * (across.beyond + down.beyond),
          .5 * (across.drawn + down.drawn),       .5 * (across.turned + down.turned)};
}

int longest_copy_px(const Grid<Rgb8>& crop, const Grid<Rgb8>& made) {
  constexpr int max = 16;
  int side = 0;
  while (side < max && shares_square(crop, made, side + 1)) ++side;
  return side;
}

}  // namespace belvedere
