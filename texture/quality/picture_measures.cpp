#include "texture/quality/picture_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <vector>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/random_streams.h"
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

}  // namespace belvedere
