#include "terrain/generalize/line_integral_generalize.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/generalize/mask.h"
#include "terrain/shape/derivatives.h"

namespace belvedere {
namespace {

// A cell's altitude and uphill direction are adjacent, so that a position on a slope line reads two
// runs of memory.
struct Place {
  float altitude_m = 0.F;
  float uphill_x = 0.F;  // columns; unit length, or 0 where the ground is level
  float uphill_y = 0.F;  // rows
  float unused = 0.F;
};

// Largest principal curvature, convex positive, times the cell: by central differences, κ = H +
// sqrt(H² - K).
Grid<float> convexity(const Grid<float>& altitude_m, double cell_m) {
  Grid<float> out(altitude_m.width(), altitude_m.height());
  const auto unit = static_cast<float>(1.0 / cell_m);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      const auto z = [&](int dx, int dy) { return altitude_m.clamped(x + dx, y + dy) * unit; };
      const float p = 0.5F * (z(1, 0) - z(-1, 0));
      const float q = 0.5F * (z(0, 1) - z(0, -1));
      const float r = z(1, 0) - 2.F * z(0, 0) + z(-1, 0);
      const float t = z(0, 1) - 2.F * z(0, 0) + z(0, -1);
      const float s = 0.25F * (z(1, 1) - z(-1, 1) - z(1, -1) + z(-1, -1));
      const float n = 1.F + p * p + q * q;
      const float mean =
          -((1.F + q * q) * r - 2.F * p * q * s + (1.F + p * p) * t) / (2.F * n * std::sqrt(n));
      const float gauss = (r * t - s * s) / (n * n);
      out(x, y) = mean + std::sqrt(std::max(mean * mean - gauss, 0.F));
    }
  });
  return out;
}

// 1 on slopes, 0 in flats of sufficient size, smooth between: a flat keeps 0 to within a few cells
// of its border.
Grid<float> find_slopes(const Grid<float>& altitude_m, double cell_m,
                        const LineIntegralParameters& parameters) {
  const Grid<float> slope = slope_deg(gaussian_blur(altitude_m, 1.5), cell_m, cell_m);
  Grid<float> steep(slope.width(), slope.height());
  std::transform(slope.begin(), slope.end(), steep.begin(),
                 [&](float deg) { return deg < parameters.flat_slope_deg ? 0.F : 1.F; });
  Grid<std::uint8_t> seen(steep.width(), steep.height());
  std::vector<std::pair<int, int>> piece;
  for (int y = 0; y < steep.height(); ++y) {
    for (int x = 0; x < steep.width(); ++x) {
      if (steep(x, y) != 0.F || seen(x, y) != 0) continue;
      piece.assign(1, {x, y});
      seen(x, y) = 1;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const auto [px, py] = piece[i];
        for (const auto& [dx, dy] :
             {std::pair{-1, 0}, std::pair{1, 0}, std::pair{0, -1}, std::pair{0, 1}}) {
          if (!steep.contains(px + dx, py + dy) || steep(px + dx, py + dy) != 0.F ||
              seen(px + dx, py + dy) != 0)
            continue;
          seen(px + dx, py + dy) = 1;
          piece.emplace_back(px + dx, py + dy);
        }
      }
      if (piece.size() >= static_cast<std::size_t>(std::max(parameters.min_flat_cells, 0)))
        continue;
      for (const auto& [px, py] : piece) steep(px, py) = 1.F;
    }
  }
  // A blur alone would give .5 at the border of a flat: only the part above .5 counts.
  Grid<float> share = gaussian_blur(steep, 3.0);
  for (float& v : share) v = smoothstep(2.F * v - 1.F);
  return share;
}

// Blurred with the standard deviation share · min(max, 1 / |κ|) cells: interpolated between the
// nearest two of a few blurs.
Grid<float> remove_detail(const Grid<float>& altitude_m, const Grid<float>& convex,
                          const Grid<float>& share, float max) {
  if (max <= 0.F) return altitude_m;
  constexpr int blurs = 5;
  Grid<float> out = altitude_m;
  Grid<float> finer = altitude_m;
  for (int b = 1; b <= blurs; ++b) {
    Grid<float> coarser = gaussian_blur(altitude_m, max * b / blurs);
    parallel_rows(out.height(), [&](int y) {
      for (int x = 0; x < out.width(); ++x) {
        const float sigma = share(x, y) * std::min(max, 1.F / (std::abs(convex(x, y)) + 1e-6F));
        const float at = sigma * blurs / max - static_cast<float>(b - 1);
        if (at > 0.F) out(x, y) = finer(x, y) + std::min(at, 1.F) * (coarser(x, y) - finer(x, y));
      }
    });
    finer = std::move(coarser);
  }
  return out;
}

// Flats are smoothed by a mean over flat cells only: slopes do not affect them, and a lake stays
// level.
void smooth_flats(Grid<float>& altitude_m, const Grid<float>& share) {
  constexpr double sigma = 2.0;
  Grid<float> weighted(altitude_m.width(), altitude_m.height());
  Grid<float> weight(altitude_m.width(), altitude_m.height());
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      weight(x, y) = 1.F - share(x, y);
      weighted(x, y) = weight(x, y) * altitude_m(x, y);
    }
  });
  weighted = gaussian_blur(weighted, sigma);
  const Grid<float> around = gaussian_blur(weight, sigma);
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      if (around(x, y) > 1e-3F)
        altitude_m(x, y) += weight(x, y) * (weighted(x, y) / around(x, y) - altitude_m(x, y));
    }
  });
}

Grid<Place> make_places(const Grid<float>& altitude_m) {
  Grid<Place> positions(altitude_m.width(), altitude_m.height());
  parallel_rows(positions.height(), [&](int y) {
    for (int x = 0; x < positions.width(); ++x) {
      // One-sided at the border, so that a plane has one direction.
      const float across = x == 0 || x == positions.width() - 1 ? 1.F : 0.5F;
      const float down = y == 0 || y == positions.height() - 1 ? 1.F : 0.5F;
      const float gx = across * (altitude_m.clamped(x + 1, y) - altitude_m.clamped(x - 1, y));
      const float gy = down * (altitude_m.clamped(x, y + 1) - altitude_m.clamped(x, y - 1));
      const float g = std::sqrt(gx * gx + gy * gy);
      const float scale = g > 1e-6F ? 1.F / g : 0.F;
      positions(x, y) = {altitude_m(x, y), gx * scale, gy * scale, 0.F};
    }
  });
  return positions;
}

// The four numbers of a position as one vector: every x86-64 has them (GCC's and Clang's vector
// extension).
using Four = float __attribute__((vector_size(16)));
static_assert(sizeof(Place) == sizeof(Four));

inline Four load(const Place& position) {
  Four values;
  std::memcpy(&values, &position, sizeof values);
  return values;
}

// Bilinear, for (x, y) not negative and within the grid.
inline Place sample(const Grid<Place>& positions, float x, float y) {
  const int x0 = std::min(static_cast<int>(x), positions.width() - 2);
  const int y0 = std::min(static_cast<int>(y), positions.height() - 2);
  const float u = x - static_cast<float>(x0);
  const float v = y - static_cast<float>(y0);
  const Place* upper = positions.row(y0) + x0;
  const Place* lower = upper + positions.width();
  const Four above = (1.F - u) * load(upper[0]) + u * load(upper[1]);
  const Four below = (1.F - u) * load(lower[0]) + u * load(lower[1]);
  const Four mixed = (1.F - v) * above + v * below;
  return {mixed[0], mixed[1], mixed[2], mixed[3]};
}

struct Sum {
  float weighted_m = 0.F;
  float weight = 0.F;
};

// Follows the slope line from cell (x, y) in steps of one cell, up (sign 1) or down (-1), to the
// end of the weights.
Sum follow(const Grid<Place>& positions, int x, int y, float sign,
           const std::vector<float>& weights, float after_turn) {
  const auto right = static_cast<float>(positions.width() - 1);
  const auto bottom = static_cast<float>(positions.height() - 1);
  auto px = static_cast<float>(x);
  auto py = static_cast<float>(y);
  Place here = positions(x, y);
  float step_m = 0.F;
  float share = 1.F;
  float last_x = 0.F;
  float last_y = 0.F;
  Sum sum;
  for (std::size_t k = 1; k < weights.size(); ++k) {
    const float length = std::sqrt(here.uphill_x * here.uphill_x + here.uphill_y * here.uphill_y);
    if (length > 1e-6F) {
      const float ux = sign * here.uphill_x / length;
      const float uy = sign * here.uphill_y / length;
      // A sharp turn: the line has reached a ridge and would continue along it or beyond it.
      if (k > 1 && ux * last_x + uy * last_y < 0.5F) share *= after_turn;
      last_x = ux;
      last_y = uy;
      px += ux;
      py += uy;
      if (px < 0.F || py < 0.F || px > right || py > bottom) {
        // Beyond the border the slope continues; from a cell on the border, with the slope on the
        // other side.
        const float back_x = px - 2.F * ux;
        const float back_y = py - 2.F * uy;
        if (k == 1 && back_x >= 0.F && back_y >= 0.F && back_x <= right && back_y <= bottom) {
          step_m = here.altitude_m - sample(positions, back_x, back_y).altitude_m;
        }
        for (std::size_t rest = k; rest < weights.size(); ++rest) {
          const auto steps = static_cast<float>(rest - k + 1);
          sum.weighted_m += share * weights[rest] * (here.altitude_m + steps * step_m);
          sum.weight += share * weights[rest];
        }
        return sum;
      }
      const Place next = sample(positions, px, py);
      step_m = next.altitude_m - here.altitude_m;
      here = next;
    }
    sum.weighted_m += share * weights[k] * here.altitude_m;
    sum.weight += share * weights[k];
  }
  return sum;
}

// Number of adjacent cells whose slope lines are followed together, to hide the latency of each
// step.
constexpr int lanes = 8;
using Lanes = std::array<float, lanes>;

struct LaneSums {
  Lanes weighted_m{};
  Lanes weight{};
};

// The same as follow() for the cells from (x, y) on, whose lines cannot reach the border.
// weights[k][i]: of step k in lane i.
void follow_inside(const Grid<Place>& positions, int x, int y, float sign,
                   const std::vector<Lanes>& weights, float after_turn, LaneSums& sums) {
  Lanes px;
  Lanes py;
  Lanes altitude_m;
  Lanes uphill_x;
  Lanes uphill_y;
  Lanes share;
  Lanes last_x{};
  Lanes last_y{};
  for (int i = 0; i < lanes; ++i) {
    const Place& here = positions(x + i, y);
    px[i] = static_cast<float>(x + i);
    py[i] = static_cast<float>(y);
    altitude_m[i] = here.altitude_m;
    uphill_x[i] = here.uphill_x;
    uphill_y[i] = here.uphill_y;
    share[i] = 1.F;
  }
  for (std::size_t k = 1; k < weights.size(); ++k) {
    const float min_cosine = k > 1 ? 0.5F : -2.F;
    for (int i = 0; i < lanes; ++i) {
      const float length = std::sqrt(uphill_x[i] * uphill_x[i] + uphill_y[i] * uphill_y[i]);
      const bool level = length <= 1e-6F;
      const float scale = (level ? 0.F : sign) / (level ? 1.F : length);
      const float ux = uphill_x[i] * scale;
      const float uy = uphill_y[i] * scale;
      // Level ground has no direction; the line keeps its last one.
      const float cosine = level ? 1.F : ux * last_x[i] + uy * last_y[i];
      share[i] *= cosine < min_cosine ? after_turn : 1.F;
      last_x[i] = level ? last_x[i] : ux;
      last_y[i] = level ? last_y[i] : uy;
      px[i] += ux;
      py[i] += uy;
    }
    for (int i = 0; i < lanes; ++i) {
      const Place next = sample(positions, px[i], py[i]);
      altitude_m[i] = next.altitude_m;
      uphill_x[i] = next.uphill_x;
      uphill_y[i] = next.uphill_y;
    }
    for (int i = 0; i < lanes; ++i) {
      const float weight = share[i] * weights[k][i];
      sums.weighted_m[i] += weight * altitude_m[i];
      sums.weight[i] += weight;
    }
  }
}

// Weights of the steps 0, 1, 2 … of a Gaussian as wide as a box of 2 length + 1 cells.
std::vector<float> line_weights(float length) {
  const float box = 2.F * length + 1.F;
  const float sigma = std::sqrt((box * box - 1.F) / 12.F);
  std::vector<float> weights;
  for (int k = 0; static_cast<float>(k) <= 2.5F * sigma; ++k) {
    const float d = static_cast<float>(k) / std::max(sigma, 1e-3F);
    weights.push_back(exact::exp(-0.5F * d * d));
  }
  return weights;
}

Grid<float> average_along_slopes(const Grid<float>& altitude_m, const Grid<float>& share,
                                 const LineIntegralParameters& parameters) {
  // Lines shorten towards flats, in a few steps.
  constexpr int lengths = 16;
  std::array<std::vector<float>, lengths + 1> weights;
  for (int i = 0; i <= lengths; ++i)
    weights[i] = line_weights(parameters.length_cells * static_cast<float>(i) / lengths);
  const Grid<Place> positions = make_places(altitude_m);
  Grid<float> out(altitude_m.width(), altitude_m.height());
  const float after_turn = 1.F - parameters.ridge_sharpness;
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(std::lround(share(x, y) * lengths));
  };
  // From this distance to the border on, a line of that many steps of one cell cannot leave the
  // grid.
  const int margin = static_cast<int>(weights.back().size());
  parallel_rows(out.height(), [&](int y) {
    std::vector<Lanes> together;
    const bool inside = y >= margin && y < out.height() - margin;
    for (int x = 0; x < out.width();) {
      if (!inside || x < margin || x + lanes > out.width() - margin) {
        const std::vector<float>& w = weights[index(x, y)];
        const Sum up = follow(positions, x, y, 1.F, w, after_turn);
        const Sum down = follow(positions, x, y, -1.F, w, 1.F);
        out(x, y) = (w[0] * altitude_m(x, y) + up.weighted_m + down.weighted_m) /
                    (w[0] + up.weight + down.weight);
        ++x;
        continue;
      }
      together.assign(1, Lanes{});
      for (int i = 0; i < lanes; ++i) {
        const std::vector<float>& w = weights[index(x + i, y)];
        if (w.size() > together.size()) together.resize(w.size(), Lanes{});
        for (std::size_t k = 0; k < w.size(); ++k) together[k][i] = w[k];
      }
      LaneSums sums;
      follow_inside(positions, x, y, 1.F, together, after_turn, sums);
      follow_inside(positions, x, y, -1.F, together, 1.F, sums);
      for (int i = 0; i < lanes; ++i)
        out(x + i, y) = (together[0][i] * altitude_m(x + i, y) + sums.weighted_m[i]) /
                        (together[0][i] + sums.weight[i]);
      x += lanes;
    }
  });
  return out;
}

void check(const LineIntegralParameters& p) {
  const auto check_range = [](const char* key, double value, double min, double max) {
    if (value >= min && value <= max) return;
    throw Error(ErrorKind::usage, fmt::format("line_integral.{}", key), fmt::format("{}", value),
                fmt::format("{}…{}", min, max));
  };
  check_range("detail_cells", p.detail_cells, 0, 20);
  check_range("flat_slope_deg", p.flat_slope_deg, 0, 30);
  check_range("length_cells", p.length_cells, 1, 20);
  check_range("iterations", p.iterations, 0, 50);
  check_range("curvature_weight", p.curvature_weight, 0, 20);
  check_range("curvature_cells", p.curvature_cells, 0, 20);
  check_range("ridge_sharpness", p.ridge_sharpness, 0, 1);
}

}  // namespace

Grid<float> generalize_along_slope_lines(const Grid<float>& altitude_m, const Grid<float>& mask,
                                         double cell_m, const LineIntegralParameters& parameters,
                                         Progress& progress) {
  check(parameters);
  progress.begin("generalize along slope lines", parameters.iterations + 1.0);
  if (altitude_m.width() < 2 || altitude_m.height() < 2) return altitude_m;
  const Grid<float> share = find_slopes(altitude_m, cell_m, parameters);
  Grid<float> out =
      remove_detail(altitude_m, convexity(altitude_m, cell_m), share, parameters.detail_cells);
  if (parameters.detail_cells > 0.F) smooth_flats(out, share);
  progress.advance(1.0);
  for (int i = 0; i < parameters.iterations; ++i) {
    Grid<float> plain = average_along_slopes(out, share, parameters);
    const Grid<float> convex = gaussian_blur(convexity(plain, cell_m), parameters.curvature_cells);
    parallel_rows(out.height(), [&](int y) {
      for (int x = 0; x < out.width(); ++x) {
        const float keep = std::min(parameters.curvature_weight * std::abs(convex(x, y)), 1.F);
        plain(x, y) = keep * out(x, y) + (1.F - keep) * plain(x, y);
      }
    });
    out = std::move(plain);
    progress.advance(1.0);
  }
  return apply_mask(altitude_m, std::move(out), mask);
}

}  // namespace belvedere
