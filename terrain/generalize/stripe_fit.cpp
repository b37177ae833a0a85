#include "terrain/generalize/stripe_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"

// Along a line the stripe's error c is fitted to the detail h = c · g + terrain, weighted by how
// smooth the terrain is. Roughness is measured without the stripes: they do not affect the detail
// *along* the line, and terrain is about as rough along as across. Outliers of the fit get less
// weight (Student's t): crests and gullies, a few cells with most of the energy, hardly count.
// A stripe may be constant along a line or vary. So c is fitted over the whole line first, then the
// residual over shorter and shorter pieces. Each time only the significant part is taken (Wiener
// filter), in four bands of width, because terrain has little detail in narrow stripes and much in
// wide ones. The noise level is the result of the same sums with alternating signs of the pieces of
// a line: that cancels stripes and keeps the terrain.
namespace belvedere {
namespace {

constexpr int taps = 8;       // of the interpolation across lines, Lanczos
constexpr int bin_cells = 8;  // sums over lines are kept for this many cells together
constexpr int flip_bins =
    2;  // pieces with alternating sign; longer than the correlation of terrain detail
constexpr double roughness_cells = 2.5;     // over which roughness is averaged
constexpr double along_period_cells = 6.0;  // of the detail along lines
constexpr float min_roughness =
    0.002F;  // of the median: limits the weight of the smoothest ground to 500 times
constexpr float min_certainty =
    0.6F;  // of the neighbouring lines: limits the certainty of a crest along a line
constexpr float max_displacement = 0.75F;  // cells; nearest neighbours shift by at most half a cell
// A line may exceed its neighbours by this factor (geometric mean of their amplitudes; a sine's
// crest has 2, a saw tooth 2.7): a ridge along the lines is a single large exception and must not
// be removed.
constexpr float max_crest_exception = 4.F;
constexpr std::array<double, 3> band_cells{0.55, 1.0, 1.8};  // Gaussians between the width bands

// Shears row y + tilt (x - centre) to row y; 0 beyond the grid.
Grid<float> sheared(const Grid<float>& values, double tilt) {
  if (tilt == 0.0) return values;
  const int width = values.width();
  const int height = values.height();
  std::vector<int> first(static_cast<std::size_t>(width));
  std::vector<std::array<float, taps>> weights(first.size());
  for (int x = 0; x < width; ++x) {
    const double shift = tilt * (x - 0.5 * (width - 1));
    const double whole = std::floor(shift);
    first[x] = static_cast<int>(whole) - taps / 2 + 1;
    double sum = 0.0;
    std::array<double, taps> w{};
    for (int k = 0; k < taps; ++k) {
      const double d = 3.14159265358979323846 * (k - taps / 2 + 1 - (shift - whole));
      w[k] =
          std::abs(d) < 1e-9 ? 1.0 : exact::sin(d) / d * exact::sin(d * 2 / taps) / (d * 2 / taps);
      sum += w[k];
    }
    for (int k = 0; k < taps; ++k) weights[x][k] = static_cast<float>(w[k] / sum);
  }
  Grid<float> out(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      float sum = 0.F;
      for (int k = 0; k < taps; ++k) {
        const int v = y + first[x] + k;
        if (v >= 0 && v < height) sum += weights[x][k] * values(x, v);
      }
      out(x, y) = sum;
    }
  });
  return out;
}

float median(const Grid<float>& values) {
  const std::size_t step = std::max<std::size_t>(1, values.size() / 65536);
  std::vector<float> some;
  for (std::size_t i = 0; i < values.size(); i += step) some.push_back(values[i]);
  return middle_value(std::move(some));
}

// Mean square of `detail` around each cell.
Grid<float> mean_square(Grid<float> detail) {
  for (float& v : detail) v *= v;
  return gaussian_blur(detail, roughness_cells);
}

// Roughness of the terrain along the lines, m². 0 on level ground: a lake has no stripes.
Grid<float> roughness_along(const Grid<float>& altitude_m) {
  Grid<float> detail = altitude_m;
  for (int pass = 0; pass < 3; ++pass) {
    const Grid<float> mean = gaussian_blur(detail, along_period_cells / 2.74, 0.0);
    for (std::size_t i = 0; i < detail.size(); ++i) detail[i] -= mean[i];
  }
  Grid<float> rough = mean_square(std::move(detail));
  const float min = std::max(min_roughness * median(rough), 1e-6F);
  for (float& v : rough) v = v > 1e-8F ? v + min : 0.F;
  return rough;
}

// Sums over bins of columns.
Grid<float> binned(const Grid<float>& values) {
  Grid<float> out((values.width() + bin_cells - 1) / bin_cells, values.height());
  parallel_rows(values.height(), [&](int y) {
    for (int x = 0; x < values.width(); ++x) out(x / bin_cells, y) += values(x, y);
  });
  return out;
}

// Sums of numerator and denominator over the cells of each line's bins.
struct Sums {
  Grid<float> p;
  Grid<float> q;
};

// The mean p / q over a triangle of 2 box - 1 bins: a box, twice. Lines that are much less certain
// than their neighbours are compared with these. Values beyond the ends are 0.
void sum_along_rows(Grid<float>& values, int box) {
  parallel_rows(values.height(), [&](int y) {
    float* row = values.row(y);
    const int width = values.width();
    const int radius = std::min(box / 2, width);
    std::vector<double> from(row, row + width);
    std::vector<double> to(from.size());
    for (int pass = 0; pass < 2; ++pass) {
      double sum = 0.0;
      for (int x = 0; x < std::min(radius, width); ++x) sum += from[x];
      for (int x = 0; x < width; ++x) {
        if (x + radius < width) sum += from[x + radius];
        if (x - radius - 1 >= 0) sum -= from[x - radius - 1];
        to[x] = sum;
      }
      from.swap(to);
    }
    for (int x = 0; x < width; ++x) row[x] = static_cast<float>(from[x]);
  });
}

// q over the window, at least a share of that of the neighbouring lines.
Grid<float> certainty(Grid<float> q, int box, double around) {
  sum_along_rows(q, box);
  const Grid<float> usual = gaussian_blur(q, 0.0, around);
  for (std::size_t i = 0; i < q.size(); ++i)
    q[i] = std::max(std::max(q[i], min_certainty * usual[i]), 1e-30F);
  return q;
}

// The significant part of a fit, by the noise level of another fit, in each band of width.
Grid<float> above_chance(const Grid<float>& fit, const Grid<float>& chance, int box,
                         double around) {
  const double along = 0.35 * std::min(box, fit.width());
  const auto energy = [&](Grid<float> band) {
    for (float& v : band) v *= v;
    return gaussian_blur(band, along, around);
  };
  Grid<float> out(fit.width(), fit.height());
  Grid<float> rest = fit;
  Grid<float> rest_of_chance = chance;
  for (std::size_t band = 0; band <= band_cells.size(); ++band) {
    const bool last = band == band_cells.size();
    Grid<float> wider =
        last ? Grid<float>(fit.width(), fit.height()) : gaussian_blur(rest, 0.0, band_cells[band]);
    Grid<float> wider_chance = last ? wider : gaussian_blur(rest_of_chance, 0.0, band_cells[band]);
    for (std::size_t i = 0; i < rest.size(); ++i) {
      rest[i] -= wider[i];
      rest_of_chance[i] -= wider_chance[i];
    }
    const Grid<float> whole = energy(rest);
    const Grid<float> by_chance = energy(rest_of_chance);
    for (std::size_t i = 0; i < rest.size(); ++i)
      out[i] += std::max(1.F - by_chance[i] / std::max(whole[i], 1e-30F), 0.F) * rest[i];
    rest = std::move(wider);
    rest_of_chance = std::move(wider_chance);
  }
  return out;
}

// The stripes implied by these sums that are constant over `box` bins.
Grid<float> fit_lines(const Sums& sums, int box, double around) {
  const Grid<float> weight = certainty(sums.q, box, around);
  Grid<float> fit = sums.p;
  sum_along_rows(fit, box);
  for (std::size_t i = 0; i < fit.size(); ++i) fit[i] /= weight[i];
  Grid<float> chance(fit.width(), fit.height());
  for (int y = 0; y < fit.height(); ++y) {
    for (int x = 0; x < fit.width(); ++x) {
      const float left = sums.p(x, y) - fit(x, y) * sums.q(x, y);
      chance(x, y) = (x / flip_bins) % 2 == 0 ? left : -left;
    }
  }
  sum_along_rows(chance, box);
  for (std::size_t i = 0; i < fit.size(); ++i) chance[i] /= weight[i];
  return above_chance(fit, chance, box, around);
}

// Removes single outlying lines.
void limit(Grid<float>& error, Follows follows, double around) {
  Grid<float> level(error.width(), error.height());
  for (std::size_t i = 0; i < error.size(); ++i) level[i] = exact::log(std::abs(error[i]) + 1e-6F);
  level = gaussian_blur(level, 0.0, around);
  for (std::size_t i = 0; i < error.size(); ++i) {
    float max = max_crest_exception * exact::exp(level[i]);
    if (follows != Follows::offset) max = std::min(max, max_displacement);
    // A line far above the limit is a crest; its weight falls with the excess.
    const float over = std::abs(error[i]) / std::max(max, 1e-12F);
    if (over > 1.F) error[i] /= over * over;
  }
}

// From bins and sheared lines back to cells.
Grid<float> spread(const Grid<float>& bins, int width, double tilt) {
  Grid<float> out(width, bins.height());
  parallel_rows(bins.height(), [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float at = std::clamp((static_cast<float>(x) + 0.5F) / bin_cells - 0.5F, 0.F,
                                  static_cast<float>(bins.width() - 1));
      const int left = std::min(static_cast<int>(at), std::max(bins.width() - 2, 0));
      const float t = at - static_cast<float>(left);
      out(x, y) = (1.F - t) * bins(left, y) + t * bins.clamped(left + 1, y);
    }
  });
  return sheared(out, -tilt);
}

struct Level {
  int box = 1;  // bins, odd
  int fits = 1;
};

// Whole lines first, then pieces of 4, 2, 1 and half the length.
std::vector<Level> plan_levels(int bins, float length_cells) {
  std::vector<Level> levels{{2 * bins + 1, 3}};
  for (const float part : {4.F, 2.F, 1.F, 0.5F}) {
    const int box = std::max(3, static_cast<int>(std::lround(part * length_cells / bin_cells)) | 1);
    if (box < 2 * bins) levels.push_back({box, part == 4.F || part == 1.F ? 2 : 1});
  }
  return levels;
}

}  // namespace

float followed(const Grid<float>& smooth_m, Follows follows, int x, int y) {
  if (follows == Follows::slope_along)
    return 0.5F * (smooth_m.clamped(x + 1, y) - smooth_m.clamped(x - 1, y));
  if (follows == Follows::slope_across)
    return 0.5F * (smooth_m.clamped(x, y + 1) - smooth_m.clamped(x, y - 1));
  return 1.F;
}

Grid<float> fit_stripes(const Grid<float>& altitude_m, const Grid<float>& height_m,
                        const Grid<float>& smooth_m, const StripeLines& lines) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  const double around = 1.5 * lines.longest_period_cells;
  const Grid<float> rough_along = roughness_along(altitude_m);
  Grid<float> error(width, height);
  Grid<float> total((width + bin_cells - 1) / bin_cells, height);
  bool first = true;
  for (const Level& level : plan_levels(total.width(), lines.length_cells)) {
    for (int fit = 0; fit < level.fits; ++fit) {
      Grid<float> left(width, height);  // residual of the stripes found so far
      parallel_rows(height, [&](int y) {
        for (int x = 0; x < width; ++x)
          left(x, y) = height_m(x, y) - error(x, y) * followed(smooth_m, lines.follows, x, y);
      });
      const Grid<float> rough_across = first ? Grid<float>() : mean_square(left);
      Grid<float> p(width, height);
      Grid<float> q(width, height);
      parallel_rows(height, [&](int y) {
        for (int x = 0; x < width; ++x) {
          const float rough = rough_along(x, y);
          if (rough <= 0.F) continue;
          const float r = left(x, y);
          const float both = first ? rough : 0.5F * (rough + rough_across(x, y));
          const float weight = 1.F / (both + r * r);
          const float g = followed(smooth_m, lines.follows, x, y);
          p(x, y) = weight * g * r;
          q(x, y) = weight * g * g;
        }
      });
      first = false;
      const Sums sums{binned(sheared(p, lines.tilt)), binned(sheared(q, lines.tilt))};
      const Grid<float> more = fit_lines(sums, level.box, around);
      for (std::size_t i = 0; i < total.size(); ++i) total[i] += more[i];
      limit(total, lines.follows, around);
      error = spread(total, width, lines.tilt);
    }
  }
  return error;
}

}  // namespace belvedere
