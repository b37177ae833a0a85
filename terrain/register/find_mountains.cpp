#include "terrain/register/find_mountains.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/matrix/matrix.h"
#include "base/parallel.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

double distance_between(glm::dvec2 a, glm::dvec2 b) { return exact::hypot(a.x - b.x, a.y - b.y); }

// Places that moved most within some distance of them, far from mountains that are known.
std::vector<glm::dvec2> displaced_centres(const PairFit& fit) {
  constexpr double apart = 0.06, min_size = 4.0;  // L; times still ground
  constexpr std::size_t max_count = 8;
  const std::vector<DisplacedPlace>& places = fit.field.places;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double size = displacement_size_m(fit.field, places[i].position);
    if (size > min_size * fit.field.still_m) order.emplace_back(-size, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<glm::dvec2> taken, out;
  for (const MovedMountain& mountain : fit.mountains) taken.push_back(handle_of(mountain).centre);
  for (const auto& [size, i] : order) {
    const glm::dvec2 at = places[i].position;
    if (std::any_of(taken.begin(), taken.end(), [&](glm::dvec2 other) {
          return distance_between(at, other) < apart * fit.frame.extent_m;
        }))
      continue;
    taken.push_back(at);
    out.push_back(at);
    if (out.size() == max_count) break;
  }
  return out;
}

struct FoundMountain {
  MovedMountain mountain;
  double gain = 0.0;  // of the cost
};

// The pairs near a place, by their first noise.
PairFit pairs_near(const PairFit& fit, glm::dvec2 centre) {
  constexpr double reach = 0.25;  // L
  PairFit out = fit;
  out.pairs.clear();
  out.noise_px.clear();
  for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
    if (distance_between(fit.pairs[i].position, centre) > reach * fit.frame.extent_m) continue;
    out.pairs.push_back(fit.pairs[i]);
    out.noise_px.push_back(fit.noise_px[i]);
  }
  out.weights.assign(out.pairs.size(), 1.0);
  return out;
}

// The likeliest mountain from one start on.
FoundMountain fit_mountain(PairFit fit, const std::vector<double>& scale_m,
                           std::vector<double> start) {
  const std::size_t n = MovedMountain::unknowns;
  const auto function = [&](std::span<const double> at) {
    std::copy(at.begin(), at.end(), fit.mountains.back().at.begin());
    if (!are_apart(handles_of(fit.mountains)))
      return Residuals{{std::numeric_limits<double>::quiet_NaN()}, Matrix(1, n)};
    const Residuals all = displacements(fit);
    const std::size_t rows = all.values.size();
    Residuals out{all.values, Matrix(rows + n, n)};
    for (std::size_t i = 0; i < rows; ++i) {
      out.values[i] /= scale_m[i];
      for (std::size_t k = 0; k < n; ++k)
        out.slopes(i, k) = all.slopes(i, all.slopes.columns() - n + k) / scale_m[i];
    }
    for (std::size_t k = 0; k < n; ++k) {
      out.slopes(rows + k, k) = 1.0;
      out.values.push_back(at[k]);
    }
    return out;
  };
  constexpr int steps = 25;
  const LeastSquaresFit found =
      fit_least_squares(std::move(start), function,
                        {.max_steps = steps, .tolerance = 1e-3, .robust = scale_m.size()});
  std::copy(found.at.begin(), found.at.end(), fit.mountains.back().at.begin());
  return {fit.mountains.back(), -found.cost};
}

// A mountain that moves as the median of the places near a centre: across the line of sight and up.
MovedMountain moved_as_near(const PairFit& fit, glm::dvec2 centre) {
  constexpr double near = 0.06, min_weight = 0.2;
  const double extent = fit.frame.extent_m;
  std::vector<double> lateral, upward;
  for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
    const DisplacedPlace& place = fit.field.places[i];
    if (distance_between(place.position, centre) > near * extent || fit.weights[i] < min_weight)
      continue;
    lateral.push_back(place.moved.lateral_m);
    upward.push_back(place.moved.upward_m);
  }
  MovedMountain out{centre, extent, {}};
  if (lateral.empty()) return out;
  const double distance = view_distance_m(fit.frame, fit.view, centre);
  const glm::dvec2 away =
      (centre - fit.frame.origin -
       extent * glm::dvec2(fit.view[view_unknown::east], fit.view[view_unknown::north])) /
      distance;
  const double right = median(lateral) / (MovedMountain::move * extent);
  out.at[3] = away.y * right;
  out.at[4] = -away.x * right;
  out.at[6] = median(upward) / view_exaggeration(fit.frame, fit.view, distance) /
              (MovedMountain::raise * extent);
  return out;
}

// One more mountain about a place, fitted to the pairs near it.
std::optional<FoundMountain> mountain_near(const PairFit& fit, glm::dvec2 centre) {
  PairFit near = pairs_near(fit, centre);
  std::vector<double> scale_m(2 * near.pairs.size());
  const std::vector<DisplacedPlace> still = displaced_places(near);
  double cost = 0.0;
  constexpr double stills = 2.0;  // more than still ground: a handle is not all
  for (std::size_t i = 0; i < still.size(); ++i) {
    const auto scale = [&](double noise_m, double moved_m) {
      const double by = exact::hypot(noise_m, stills * fit.field.still_m);
      cost += 0.5 * exact::log(1.0 + square(moved_m / by));
      return by;
    };
    scale_m[i] = scale(still[i].noise.lateral_m, still[i].moved.lateral_m);
    scale_m[still.size() + i] = scale(still[i].noise.upward_m, still[i].moved.upward_m);
  }
  const MovedMountain moved = moved_as_near(fit, centre);
  near.mountains.push_back(moved);
  std::optional<FoundMountain> best;
  for (const double radius : {-0.8, 0.3, 1.3})
    for (const double turn : {-1.0, 0.0, 1.0})
      for (const double share : {0.0, 1.0}) {
        std::vector<double> start(moved.at.begin(), moved.at.end());
        for (double& v : start) v *= share;
        start[2] = radius;
        start[5] = turn;
        FoundMountain found = fit_mountain(near, scale_m, std::move(start));
        found.gain += cost;
        if (!std::isfinite(found.gain)) continue;  // it would overlap another from the start
        if (!best || found.gain > best->gain) best = found;
      }
  return best;
}

bool are_alike(const MovedMountain& a, const MovedMountain& b) {
  const DeformHandle one = handle_of(a), other = handle_of(b);
  constexpr double near = 0.1, turned_deg = 6.0;  // of the radius
  const double limit = near * std::min(one.radius_m, other.radius_m);
  return distance_between(one.centre, other.centre) < limit &&
         distance_between(one.move_m, other.move_m) < limit &&
         std::abs(one.radius_m - other.radius_m) < limit &&
         std::abs(one.rotate_deg - other.rotate_deg) < turned_deg;
}

// The others' score, if the pairs' own is not worse by more than chance.
std::optional<double> gain_over(const WeighedPairs& before, const WeighedPairs& after) {
  constexpr double chance = 1.0;
  const auto pairs = static_cast<double>(before.index.size());
  if (pairs * (mean_score(after) - mean_score(before)) < -chance) return std::nullopt;
  return after.judgement.score - before.judgement.score;
}

constexpr int weighing_rounds = 3;

// The best of the fits with one change; nothing if none gains as much.
std::optional<WeighedPairs> best_of(const WeighedPairs& before, std::vector<WeighedPairs> tried,
                                    double min_gain, double sigma_px) {
  parallel_rows(static_cast<int>(tried.size()), [&](int i) {
    weigh_by_agreement(tried[static_cast<std::size_t>(i)], sigma_px, weighing_rounds);
  });
  std::optional<std::size_t> best;
  double best_gain = min_gain;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const std::optional<double> gain = gain_over(before, tried[i]);
    if (gain && *gain > best_gain) best_gain = *gain, best = i;
  }
  if (!best) return std::nullopt;
  return std::move(tried[*best]);
}

}  // namespace

std::vector<MovedMountain> propose_mountains(const PairFit& fit) {
  std::vector<FoundMountain> found;
  for (const glm::dvec2 centre : displaced_centres(fit)) {
    const std::optional<FoundMountain> best = mountain_near(fit, centre);
    constexpr double min_gain = 2.0;
    if (!best || best->gain <= min_gain) continue;
    if (std::none_of(found.begin(), found.end(), [&](const FoundMountain& other) {
          return are_alike(other.mountain, best->mountain);
        }))
      found.push_back(*best);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const FoundMountain& a, const FoundMountain& b) { return a.gain > b.gain; });
  std::vector<MovedMountain> out(found.size());
  std::transform(found.begin(), found.end(), out.begin(),
                 [](const FoundMountain& each) { return each.mountain; });
  return out;
}

void move_mountains(WeighedPairs& weighed, double sigma_px) {
  constexpr std::size_t max_mountains = 12;
  constexpr double min_gain = 2.0, min_gain_without = -1.0;
  for (;;) {
    std::vector<WeighedPairs> tried;
    for (std::size_t i = 0; i < weighed.fit.mountains.size(); ++i) {
      WeighedPairs& without = tried.emplace_back(weighed);
      without.fit.mountains.erase(without.fit.mountains.begin() + static_cast<std::ptrdiff_t>(i));
    }
    auto best = best_of(weighed, std::move(tried), min_gain_without, sigma_px);
    if (!best) break;
    weighed = *std::move(best);
  }
  while (weighed.fit.mountains.size() < max_mountains) {
    std::vector<WeighedPairs> tried;
    for (const MovedMountain& mountain : propose_mountains(weighed.fit)) {
      WeighedPairs with = weighed;
      with.fit.mountains.push_back(mountain);
      if (are_apart(handles_of(with.fit.mountains))) tried.push_back(std::move(with));
    }
    auto best = best_of(weighed, std::move(tried), min_gain, sigma_px);
    if (!best) break;
    weighed = *std::move(best);
  }
}

}  // namespace belvedere
