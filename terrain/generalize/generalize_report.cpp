#include "terrain/generalize/generalize_report.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/pyramid.h"
#include "base/statistics.h"
#include "terrain/generalize/mask.h"
#include "terrain/shape/hydrology.h"
#include "terrain/shape/mask_pieces.h"

namespace belvedere {
namespace {

int slice_at(float share, int slices) {
  return std::clamp(static_cast<int>(std::floor((1.0 - static_cast<double>(share)) * slices)), 0,
                    slices - 1);
}

// Sums by slice, per row and then over the rows, so that the result does not depend on the number
// of threads. add(x, y, sums) adds to sums of [slice].
template <class Sums, class F>
std::vector<Sums> sum_slices(int width, int height, int slices, F&& add) {
  std::vector<std::vector<Sums>> rows(static_cast<std::size_t>(height),
                                      std::vector<Sums>(static_cast<std::size_t>(slices)));
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) add(x, y, rows[static_cast<std::size_t>(y)]);
  });
  std::vector<Sums> total(static_cast<std::size_t>(slices));
  for (const std::vector<Sums>& row : rows)
    for (std::size_t i = 0; i < total.size(); ++i) total[i] += row[i];
  return total;
}

struct Mean {
  double sum = 0.0;
  std::size_t count = 0;
  Mean& operator+=(const Mean& other) {
    sum += other.sum;
    count += other.count;
    return *this;
  }
  double value() const { return count == 0 ? 0.0 : sum / static_cast<double>(count); }
};

// Second derivatives of the least-squares quadric (Evans 1980, Young 1978), x east, y north, and
// its gradient.
struct Bend {
  double p, q, r, s, t;
};

Bend fit(const Grid<float>& z, int x, int y, glm::dvec2 cell_m) {
  const auto at = [&](int dx, int dy) { return static_cast<double>(z.clamped(x + dx, y + dy)); };
  const double nw = at(-1, -1), n = at(0, -1), ne = at(1, -1), w = at(-1, 0), c = at(0, 0),
               e = at(1, 0), sw = at(-1, 1), s = at(0, 1), se = at(1, 1);
  return {(ne + e + se - nw - w - sw) / (6.0 * cell_m.x),
          (nw + n + ne - sw - s - se) / (6.0 * cell_m.y),
          (nw + ne + w + e + sw + se - 2.0 * (n + c + s)) / (3.0 * cell_m.x * cell_m.x),
          (ne + sw - nw - se) / (4.0 * cell_m.x * cell_m.y),
          (nw + n + ne + sw + s + se - 2.0 * (w + c + e)) / (3.0 * cell_m.y * cell_m.y)};
}

// The smaller eigenvalue of [r s; s t].
double min_bend(const Bend& b) { return 0.5 * (b.r + b.t) - exact::hypot(0.5 * (b.r - b.t), b.s); }

// Whether the quadric has its maximum within the cell, along the direction of its smallest second
// derivative.
bool culminates(const Bend& b, double min, glm::dvec2 cell_m) {
  // The longer row of [H - smallest] is perpendicular to the eigenvector with less error.
  glm::dvec2 along(b.s, min - b.r);
  const glm::dvec2 other(min - b.t, b.s);
  if (other.x * other.x + other.y * other.y > along.x * along.x + along.y * along.y) along = other;
  const double length = exact::hypot(along.x, along.y);
  if (length == 0.0) return false;  // isotropic curvature: a summit, no line
  along = along / length;
  const double offset = -(b.p * along.x + b.q * along.y) / min;
  // A little over half a cell, so that lines between two columns have no gaps.
  constexpr double reach_cells = 0.6;
  return std::abs(offset * along.x) <= reach_cells * cell_m.x &&
         std::abs(offset * along.y) <= reach_cells * cell_m.y;
}

// Energy and crest curvature of one terrain, by slices.
struct Look {
  double gaussian_cells = 0.0;
  std::vector<std::vector<double>> energy_m2;
  std::vector<double> curvature_per_m;
};

Look look_at(const Grid<float>& altitude_m, double gaussian_cells, const Grid<std::uint8_t>& ridges,
             const Grid<std::uint8_t>& slice_of, glm::dvec2 cell_m, const Grid<float>& share,
             int bands, int slices) {
  Look look;
  look.gaussian_cells = gaussian_cells;
  look.energy_m2 = band_energy(altitude_m, share, bands, slices);
  const std::vector<Mean> means = sum_slices<Mean>(
      ridges.width(), ridges.height(), slices, [&](int x, int y, std::vector<Mean>& sums) {
        if (ridges(x, y) != 0)
          sums[slice_of(x, y)] += {-min_bend(fit(altitude_m, x, y, cell_m)), 1};
      });
  for (const Mean& mean : means) look.curvature_per_m.push_back(mean.value());
  return look;
}

// Interpolates between two values that fall like a blurred wave, exp(-σ²): linear in the logarithm
// if both have one.
double between(double a, double b, double t) {
  return a > 0.0 && b > 0.0 ? a * exact::pow(b / a, t) : a + t * (b - a);
}

}  // namespace

Grid<std::uint8_t> distance_slices(const Grid<float>& foreground_share, glm::ivec2 size,
                                   int slices) {
  if (slices < 1 || slices > 255)
    throw Error(ErrorKind::bug, "distance_slices", "the number of slices is outside 1 … 255");
  Grid<std::uint8_t> out(size.x, size.y);
  if (foreground_share.empty()) return out;
  if (!foreground_share.same_size(out))
    throw Error(ErrorKind::bug, "distance_slices", "the foreground share differs in size");
  std::transform(
      foreground_share.begin(), foreground_share.end(), out.begin(),
      [slices](float share) { return static_cast<std::uint8_t>(slice_at(share, slices)); });
  return out;
}

std::vector<std::vector<double>> band_energy(const Grid<float>& altitude_m,
                                             const Grid<float>& foreground_share, int bands,
                                             int slices) {
  const LaplacianPyramid pyramid = make_laplacian_pyramid(altitude_m, bands);
  const std::vector<Grid<float>> shares =
      foreground_share.empty()
          ? std::vector<Grid<float>>()
          : make_gaussian_pyramid(foreground_share, static_cast<int>(pyramid.bands.size()));
  // Bands that a small terrain cannot have are 0.
  std::vector<std::vector<double>> energy(
      static_cast<std::size_t>(slices), std::vector<double>(static_cast<std::size_t>(bands), 0.0));
  for (std::size_t level = 0; level < pyramid.bands.size(); ++level) {
    const Grid<float>& band = pyramid.bands[level];
    const std::vector<Mean> means = sum_slices<Mean>(
        band.width(), band.height(), slices, [&](int x, int y, std::vector<Mean>& sums) {
          const auto slice =
              static_cast<std::size_t>(shares.empty() ? 0 : slice_at(shares[level](x, y), slices));
          const double v = band(x, y);
          sums[slice] += {v * v, 1};
        });
    for (std::size_t slice = 0; slice < means.size(); ++slice)
      energy[slice][static_cast<std::size_t>(bands) - 1 - level] = means[slice].value();
  }
  return energy;
}

std::vector<AltitudeChange> altitude_change(const Grid<float>& before_m, const Grid<float>& after_m,
                                            const Grid<std::uint8_t>& slice_of, int slices) {
  struct Sums {
    double sum = 0.0;
    double squares = 0.0;
    double largest = 0.0;
    std::size_t count = 0;
    Sums& operator+=(const Sums& o) {
      sum += o.sum;
      squares += o.squares;
      largest = std::max(largest, o.largest);
      count += o.count;
      return *this;
    }
  };
  const std::vector<Sums> sums = sum_slices<Sums>(
      before_m.width(), before_m.height(), slices, [&](int x, int y, std::vector<Sums>& all) {
        const double d = static_cast<double>(after_m(x, y)) - before_m(x, y);
        all[slice_of(x, y)] += {d, d * d, std::abs(d), 1};
      });
  std::vector<AltitudeChange> changes;
  for (const Sums& s : sums) {
    const double n = std::max(static_cast<double>(s.count), 1.0);
    changes.push_back({s.count, s.sum / n, std::sqrt(s.squares / n), s.largest});
  }
  return changes;
}

Grid<float> crest_curvature(const Grid<float>& altitude_m, glm::dvec2 cell_m) {
  Grid<float> out(altitude_m.width(), altitude_m.height());
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x)
      out(x, y) = static_cast<float>(-min_bend(fit(altitude_m, x, y, cell_m)));
  });
  return out;
}

Grid<std::uint8_t> ridge_lines(const Grid<float>& altitude_m, glm::dvec2 cell_m) {
  const Grid<float> smooth = gaussian_blur(altitude_m, 1.0);
  // Curvature times cell, a change of slope, below which a crest is rounding of altitudes.
  constexpr double min_change = 0.01;
  const double min_curvature = min_change / (0.5 * (cell_m.x + cell_m.y));
  Grid<float> sharpness(altitude_m.width(), altitude_m.height());
  parallel_rows(smooth.height(), [&](int y) {
    if (y == 0 || y == smooth.height() - 1) return;
    for (int x = 1; x + 1 < smooth.width(); ++x) {
      const Bend bend = fit(smooth, x, y, cell_m);
      const double min = min_bend(bend);
      if (-min >= min_curvature && culminates(bend, min, cell_m))
        sharpness(x, y) = static_cast<float>(-min);
    }
  });
  std::vector<float> crests;
  std::copy_if(sharpness.begin(), sharpness.end(), std::back_inserter(crests),
               [](float v) { return v > 0.F; });
  Grid<std::uint8_t> out(altitude_m.width(), altitude_m.height());
  if (crests.empty()) return out;
  const float min = value_at_rank(crests, crests.size() * 3 / 4);
  std::transform(sharpness.begin(), sharpness.end(), out.begin(),
                 [min](float v) { return static_cast<std::uint8_t>(v >= min); });
  return out;
}

std::vector<RidgeSharpness> ridge_sharpness(const Grid<float>& before_m, const Grid<float>& after_m,
                                            glm::dvec2 cell_m, const Grid<float>& foreground_share,
                                            int bands, int slices) {
  const Grid<std::uint8_t> ridges = ridge_lines(before_m, cell_m);
  const Grid<std::uint8_t> slice_of =
      distance_slices(foreground_share, {before_m.width(), before_m.height()}, slices);
  const auto look = [&](const Grid<float>& z, double sigma) {
    return look_at(z, sigma, ridges, slice_of, cell_m, foreground_share, bands, slices);
  };
  const Look after = look(after_m, 0.0);
  // Each slice may need a different Gaussian: a ladder of them serves all.
  std::vector<Look> ladder = {look(before_m, 0.0)};
  for (const double sigma :
       {0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 11.3, widest_gaussian_cells})
    ladder.push_back(look(gaussian_blur(before_m, sigma), sigma));

  const std::vector<Mean> counts = sum_slices<Mean>(ridges.width(), ridges.height(), slices,
                                                    [&](int x, int y, std::vector<Mean>& sums) {
                                                      if (ridges(x, y) != 0)
                                                        sums[slice_of(x, y)] += {0.0, 1};
                                                    });
  std::vector<RidgeSharpness> out;
  for (std::size_t slice = 0; slice < static_cast<std::size_t>(slices); ++slice) {
    std::vector<std::size_t> quieter;
    for (std::size_t band = 0; band < static_cast<std::size_t>(bands); ++band)
      if (after.energy_m2[slice][band] < ladder[0].energy_m2[slice][band]) quieter.push_back(band);
    const auto energy = [&](const Look& l) {
      double sum = 0.0;
      for (const std::size_t band : quieter) sum += l.energy_m2[slice][band];
      return sum;
    };
    RidgeSharpness sharp;
    sharp.cells = counts[slice].count;
    sharp.before_per_m = sharp.gaussian_per_m = ladder[0].curvature_per_m[slice];
    sharp.after_per_m = after.curvature_per_m[slice];
    const double target = energy(after);
    for (std::size_t i = 1; i < ladder.size() && !quieter.empty(); ++i) {
      const Look& a = ladder[i - 1];
      const Look& b = ladder[i];
      sharp.gaussian_cells = b.gaussian_cells;
      sharp.gaussian_per_m = b.curvature_per_m[slice];
      const double high = energy(a);
      const double low = energy(b);
      if (low > target) continue;
      // A wave's energy falls as exp(-4π²σ²/λ²): its logarithm is linear in σ².
      const double t = low > 0.0 && target > 0.0 && high > low
                           ? exact::log(high / target) / exact::log(high / low)
                           : 1.0;
      const double from = a.gaussian_cells * a.gaussian_cells;
      sharp.gaussian_cells = std::sqrt(from + t * (b.gaussian_cells * b.gaussian_cells - from));
      sharp.gaussian_per_m = between(a.curvature_per_m[slice], b.curvature_per_m[slice], t);
      break;
    }
    out.push_back(sharp);
  }
  return out;
}

Grid<std::uint8_t> slope_feet(const Grid<float>& altitude_m, glm::dvec2 cell_m, int bands) {
  const Grid<float> mask = slope_foot_mask(altitude_m, cell_m, 1 << std::clamp(bands, 1, 8));
  Grid<std::uint8_t> feet(mask.width(), mask.height());
  std::transform(mask.begin(), mask.end(), feet.begin(),
                 [](float m) { return static_cast<std::uint8_t>(m < 0.5F); });
  return feet;
}

Pits find_pits(const Grid<float>& before_m, const Grid<float>& after_m,
               const Grid<std::uint8_t>& feet, glm::dvec2 cell_m) {
  const Grid<float> filled = fill_hollows(after_m);
  const double area_m2 = cell_m.x * cell_m.y;
  constexpr float min_depth_m = 0.5F;
  Mask hollow(after_m.width(), after_m.height());
  Pits pits;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const float depth_m = filled[i] - after_m[i];
    const double volume_m3 = depth_m * area_m2;
    hollow[i] = depth_m > min_depth_m ? 1 : 0;
    pits.hollows_m3 += volume_m3;
    pits.deepest_m = std::max(pits.deepest_m, static_cast<double>(depth_m));
    if (feet[i] == 0) continue;
    pits.at_feet_m3 += volume_m3;
    pits.lowered_m3 += std::max(0.0, static_cast<double>(before_m[i]) - after_m[i]) * area_m2;
  }
  each_piece(hollow, 1, [&](const std::vector<std::int32_t>& cells) {
    const auto depth_m = [&](std::int32_t at) {
      return filled[static_cast<std::size_t>(at)] - after_m[static_cast<std::size_t>(at)];
    };
    const std::int32_t deepest =
        *std::max_element(cells.begin(), cells.end(),
                          [&](std::int32_t a, std::int32_t b) { return depth_m(a) < depth_m(b); });
    ++pits.count;
    pits.at_feet += feet[static_cast<std::size_t>(deepest)] != 0 ? 1 : 0;
  });
  return pits;
}

}  // namespace belvedere
