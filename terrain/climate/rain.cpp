#include "terrain/climate/rain.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/matrix/matrix.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/statistics.h"
#include "terrain/climate/horizon_sweep.h"

namespace belvedere {
namespace {

constexpr std::size_t max_terms = 4;  // 1, altitude, x, y
constexpr std::uint64_t rain_seed =
    0x7261696eULL;  // not a stream of pictures: only a range in a report depends on it
using Terms = std::array<double, max_terms>;

// One station in the regression: terms in km from the centre.
struct Row {
  Terms term;
  double rain_mm;
};

double foretell(const Terms& factor, const Row& row, std::size_t terms) {
  double sum = 0.0;
  for (std::size_t k = 0; k < terms; ++k) sum += factor[k] * row.term[k];
  return sum;
}

// Weighted least squares; nothing if the stations are collinear or all at one altitude.
std::optional<Terms> solve_weighted(const std::vector<Row>& rows, const std::vector<double>& weight,
                                    std::size_t terms) {
  Matrix normal(terms, terms);
  std::vector<double> right(terms, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t r = 0; r < terms; ++r) {
      for (std::size_t c = 0; c <= r; ++c)
        normal(r, c) += weight[i] * rows[i].term[r] * rows[i].term[c];
      right[r] += weight[i] * rows[i].term[r] * rows[i].rain_mm;
    }
  const std::optional<Cholesky> factors = Cholesky::of(std::move(normal), 1e-9);
  if (!factors) return {};
  Terms factor{};
  std::ranges::copy(factors->solve(right), factor.begin());
  return factor;
}

// Huber's regression by 20 iterations of reweighting.
std::optional<Terms> solve_robust(const std::vector<Row>& rows, std::size_t terms) {
  std::vector<double> weight(rows.size(), 1.0);
  std::optional<Terms> factor = solve_weighted(rows, weight, terms);
  for (int round = 0; round < 20 && factor; ++round) {
    std::vector<double> off;
    for (const Row& row : rows)
      off.push_back(std::abs(row.rain_mm - foretell(*factor, row, terms)));
    const double deviation =
        std::max(1e-6, 1.4826 * median(off));  // of a normal distribution with that median
    for (std::size_t i = 0; i < rows.size(); ++i)
      weight[i] = std::min(1.0, 1.345 * deviation / std::max(off[i], 1e-12));
    factor = solve_weighted(rows, weight, terms);
  }
  return factor;
}

}  // namespace

double RainPlane::at(glm::dvec2 position, double altitude_m) const {
  const glm::dvec2 away_km = (position - centre) / 1000.0;
  return std::max(0.0, at_centre_mm + mm_per_km_up * (altitude_m - centre_m) / 1000.0 +
                           mm_per_km.x * away_km.x + mm_per_km.y * away_km.y);
}

RainPlane fit_rain(const std::vector<Station>& all, const std::vector<double>& wind_share,
                   int bootstrap_samples) {
  std::vector<Station> stations;
  std::vector<double> share;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::isnan(all[i].rain_mm)) continue;
    stations.push_back(all[i]);
    share.push_back(wind_share.empty() ? 1.0 : wind_share[i]);
    stations.back().rain_mm /= share.back();
  }
  if (stations.empty())
    throw Error(ErrorKind::input, "stations", "no station has rain data",
                "a column rain_mm with numbers");
  RainPlane plane;
  plane.stations = static_cast<int>(stations.size());
  const auto count = static_cast<double>(stations.size());
  for (const Station& station : stations) {
    plane.centre += station.position / count;
    plane.centre_m += station.altitude_m / count;
  }
  std::vector<Row> rows;
  std::vector<double> rain;
  for (const Station& station : stations) {
    const glm::dvec2 away_km = (station.position - plane.centre) / 1000.0;
    rows.push_back({{1.0, (station.altitude_m - plane.centre_m) / 1000.0, away_km.x, away_km.y},
                    station.rain_mm});
    rain.push_back(station.rain_mm);
  }
  plane.at_centre_mm = median(rain);
  const auto set_error = [&] {
    for (std::size_t i = 0; i < stations.size(); ++i)
      plane.off_mm +=
          share[i] / count *
          std::abs(stations[i].rain_mm - plane.at(stations[i].position, stations[i].altitude_m));
  };
  std::size_t terms = rows.size() < 4 ? 1 : rows.size() < fewest_stations ? 2 : 4;
  std::optional<Terms> factor;
  // Stations on one line, or all at one altitude, determine fewer terms.
  for (; terms > 1 && !factor; terms = factor ? terms : terms / 2)
    factor = solve_robust(rows, terms);
  if (!factor) {
    set_error();
    return plane;
  }
  plane.at_centre_mm = (*factor)[0];
  plane.mm_per_km_up = (*factor)[1];
  if (terms == 4) plane.mm_per_km = {(*factor)[2], (*factor)[3]};
  set_error();

  std::vector<double> gradients;
  std::vector<Row> drawn(rows.size());
  for (int sample = 0; sample < bootstrap_samples; ++sample) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      drawn[i] = rows[random_index(static_cast<std::uint32_t>(rows.size()), rain_seed, sample,
                                   static_cast<std::int64_t>(i))];
    if (const std::optional<Terms> again = solve_robust(drawn, terms))
      gradients.push_back((*again)[1]);
  }
  plane.low_mm_per_km_up =
      gradients.empty() ? plane.mm_per_km_up : value_at_share(gradients, 0.025);
  plane.high_mm_per_km_up =
      gradients.empty() ? plane.mm_per_km_up : value_at_share(gradients, 0.975);
  double sum = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<Row> others = rows;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Terms without = solve_robust(others, terms).value_or(*factor);
    const double error = share[i] * (rows[i].rain_mm - foretell(without, rows[i], terms));
    sum += error * error;
  }
  plane.left_out_mm = std::sqrt(sum / count);
  return plane;
}

Grid<float> upslope_rain(const Grid<float>& altitude_m, glm::dvec2 cell_m,
                         const UpslopeParameters& p) {
  const auto require = [](bool good, const char* where, double found, const char* allowed) {
    if (!good) throw Error(ErrorKind::usage, where, fmt::format("{}", found), allowed);
  };
  require(p.wind_m_s >= 1.0 && p.wind_m_s <= 50.0, "wind_m_s", p.wind_m_s, "1 … 50 m/s");
  require(p.delay_s >= 10.0 && p.delay_s <= 2000.0, "delay_s", p.delay_s, "10 … 2000 s");
  require(p.strength >= 0.0 && p.strength <= 2.0, "strength", p.strength, "0 … 2");
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  Grid<float> share(width, height);
  const SweepPlan plan =
      plan_sweep(width, height, cell_m, exact::turn(to_radians(p.wind_from_deg)));
  const auto length = static_cast<std::size_t>(plan.length);
  // A step along the wind in lengths of the tail, and the remainder of a tail after it.
  const double way = plan.step_m / (p.wind_m_s * p.delay_s);
  const double left = exact::exp(-way);
  const double rise_of_step = p.strength * p.wind_m_s / plan.step_m;
  const auto height_at = [&](std::size_t point, int across) {
    const int cell = std::clamp(across, 0, plan.across - 1);
    return static_cast<double>(plan.along_rows ? altitude_m(static_cast<int>(point), cell)
                                               : altitude_m(cell, static_cast<int>(point)));
  };
  // Along a line from its upwind end: uplift w, its first tail a and its second tail b. If w is
  // constant over a step, both are exact: a → w + (a - w) e, b → w + (b - w + (a - w) way) e, where
  // e is the remainder. NaN beyond the grid.
  const auto run_line = [&](int line, std::vector<float>& out) {
    double a = 0.0;
    double b = 0.0;
    double before = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = 0; k < length; ++k) {
      const std::size_t point = plan.from_end ? length - 1 - k : k;
      const int across = line + plan.whole[point];
      if (across < -1 || across >= plan.across) {
        out[point] = std::numeric_limits<float>::quiet_NaN();
        continue;
      }
      const double low = height_at(point, across);
      const double high = height_at(point, across + 1);
      double here = low + (high - low) * static_cast<double>(plan.part[point]);
      if (std::isnan(here)) here = before;
      const double rise =
          std::isnan(here) || std::isnan(before) ? 0.0 : rise_of_step * (here - before);
      b = rise + (b - rise + (a - rise) * way) * left;
      a = rise + (a - rise) * left;
      before = here;
      out[point] = static_cast<float>(b);
    }
  };
  parallel_ranges(plan.last_line - plan.first_line, 8, [&](int begin, int end) {
    std::vector<float> upper(length);
    std::vector<float> lower(length);
    run_line(plan.first_line + begin, lower);
    for (int line = begin; line < end; ++line) {
      std::swap(upper, lower);
      run_line(plan.first_line + line + 1, lower);
      for (std::size_t point = 0; point < length; ++point) {
        const int cell = plan.first_line + line + plan.up[point];
        if (cell < 0 || cell >= plan.across) continue;
        const float mixed = lower[point] + (upper[point] - lower[point]) * plan.back[point];
        const float value = !std::isnan(mixed)          ? mixed
                            : !std::isnan(upper[point]) ? upper[point]
                                                        : lower[point];
        (plan.along_rows ? share(static_cast<int>(point), cell)
                         : share(cell, static_cast<int>(point))) = value;
      }
    }
  });
  return share;
}

}  // namespace belvedere
