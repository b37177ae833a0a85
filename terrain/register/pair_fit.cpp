#include "terrain/register/pair_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/matrix/least_squares.h"
#include "terrain/register/leave_out.h"

namespace belvedere {
namespace {

namespace unknown = view_unknown;

// Residuals, lateral then upward, and their derivatives by the view.
Residuals displacements(const PairFit& fit, const ViewUnknowns& view) {
  const std::size_t n = fit.pairs.size();
  Residuals out{std::vector<double>(2 * n), Matrix(2 * n, unknown::count)};
  for (std::size_t i = 0; i < n; ++i) {
    const ViewDisplacement seen = displacement_in_view(fit.frame, view, fit.pairs[i]);
    const auto set = [&](std::size_t row, const ViewNumber& value) {
      out.values[row] = value.value;
      std::copy(value.slope.begin(), value.slope.end(), out.slopes.row(row).begin());
    };
    set(i, seen.lateral_m);
    set(n + i, seen.upward_m);
  }
  return out;
}

// Of displacements() if the ground moves as the field says and pixels are clicked with its noise.
Matrix whole_covariance(const DisplacementParameters& field) {
  const std::size_t n = field.places.size();
  const Matrix ground = displacement_covariance(field);
  Matrix out(2 * n, 2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) out(i, k) = out(n + i, n + k) = ground(i, k);
    out(i, i) += square(field.places[i].noise.lateral_m);
    out(n + i, n + i) += square(field.places[i].noise.upward_m);
  }
  return out;
}

Cholesky factors_of_pairs(const DisplacementParameters& field) {
  std::optional<Cholesky> factors = Cholesky::of(whole_covariance(field));
  if (!factors)
    throw Error(ErrorKind::bug, "registration", "a covariance is not positive definite");
  return *std::move(factors);
}

// One deviation of the priors weighs like two pixels.
ViewNumber weighed(const ViewNumber& prior, double sigma_px) {
  return prior * ViewNumber(2.0 / sigma_px);
}

// Inverse covariance of the view's unknowns before there are pairs.
Matrix prior_precision(const PairFit& fit, double sigma_px) {
  Matrix precision(unknown::count, unknown::count);
  constexpr double min_precision = 1e-4;
  for (const ViewNumber& prior : view_priors(fit.frame, fit.view)) {
    const ViewNumber scaled = weighed(prior, sigma_px);
    for (std::size_t i = 0; i < unknown::count; ++i)
      for (std::size_t k = 0; k < unknown::count; ++k)
        precision(i, k) += scaled.slope[i] * scaled.slope[k];
  }
  for (std::size_t i = 0; i < unknown::count; ++i) precision(i, i) += min_precision;
  return precision;
}

}  // namespace

std::vector<DisplacedPlace> displaced_places(const PairFit& fit) {
  std::vector<DisplacedPlace> places;
  for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
    const ViewDisplacement seen = displacement_in_view(fit.frame, fit.view, fit.pairs[i]);
    const glm::dvec2 noise_px = fit.noise_px[i] / std::sqrt(fit.weights[i]);
    places.push_back({fit.pairs[i].position,
                      {seen.lateral_m.value, seen.upward_m.value},
                      {noise_px.x / seen.px_per_m.lateral_m, noise_px.y / seen.px_per_m.upward_m}});
  }
  return places;
}

ViewUnknowns refitted_view(const PairFit& fit, double sigma_px) {
  const Cholesky factors = factors_of_pairs(fit.field);
  const auto residuals = [&](std::span<const double> at) {
    ViewUnknowns view;
    std::copy(at.begin(), at.end(), view.begin());
    const Residuals moved = displacements(fit, view);
    const std::vector<double> white = factors.whitened(moved.values);
    const Matrix slopes = factors.whitened(moved.slopes);
    const std::vector<ViewNumber> priors = view_priors(fit.frame, view);
    Residuals out{white, Matrix(white.size() + priors.size(), unknown::count)};
    for (std::size_t i = 0; i < white.size(); ++i)
      std::copy(slopes.row(i).begin(), slopes.row(i).end(), out.slopes.row(i).begin());
    for (std::size_t i = 0; i < priors.size(); ++i) {
      const ViewNumber prior = weighed(priors[i], sigma_px);
      out.values.push_back(prior.value);
      std::copy(prior.slope.begin(), prior.slope.end(), out.slopes.row(white.size() + i).begin());
    }
    return out;
  };
  constexpr int steps = 15;
  const LeastSquaresFit found = fit_least_squares({fit.view.begin(), fit.view.end()}, residuals,
                                                  {.max_steps = steps, .tolerance = 1e-8});
  ViewUnknowns view;
  std::copy(found.at.begin(), found.at.end(), view.begin());
  return view;
}

Matrix view_covariance(const PairFit& fit, double sigma_px) {
  Matrix precision =
      normal_matrix(factors_of_pairs(fit.field).whitened(displacements(fit, fit.view).slopes));
  const Matrix prior = prior_precision(fit, sigma_px);
  for (std::size_t i = 0; i < unknown::count; ++i)
    for (std::size_t k = 0; k < unknown::count; ++k) precision(i, k) += prior(i, k);
  const std::optional<Cholesky> factors = Cholesky::of(std::move(precision));
  if (!factors) throw Error(ErrorKind::bug, "registration", "no view is likely");
  return factors->inverse();
}

PairJudgement judge_pairs(const PairFit& fit, double sigma_px) {
  const std::size_t n = fit.pairs.size();
  const Residuals moved = displacements(fit, fit.view);
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < n; ++i) groups.push_back({i, n + i});
  PairJudgement out;
  // The slopes of observed less modelled: those of the model reversed, which has no effect.
  const std::vector<LeftOut> left_out =
      leave_out(whole_covariance(fit.field), moved.slopes, prior_precision(fit, sigma_px),
                moved.values, groups);
  for (std::size_t i = 0; i < n; ++i) {
    const DisplacedPlace& place = fit.field.places[i];
    const double size = displacement_size_m(fit.field, place.position);
    const double size_by_others = displacement_size_m(fit.field, place.position, i);
    double square_px = 0.0, square_honest = 0.0, square_deviations = 0.0, score = 0.0;
    const auto add = [&](std::size_t part, double noise_m, double noise_px) {
      const double px_per_m = noise_px / std::sqrt(fit.weights[i]) / noise_m;
      const double residual = left_out[i].residuals[part];
      const double variance = left_out[i].covariance(part, part);
      square_px += square(residual * px_per_m);
      const double ground_variance = std::max(variance - square(noise_m), 0.0);
      square_deviations +=
          square(residual * px_per_m) / (ground_variance * square(px_per_m) + square(noise_px));
      // A pair must not vouch for itself: the same if its ground had the size that others give it.
      const double share = ground_variance / square(size);
      const double observed = part == 0 ? moved.values[i] : moved.values[n + i];
      const double honest = observed - (observed - residual) * size_by_others / size;
      const double honest_variance = square(size_by_others) * share + square(noise_m);
      const double deviations2 = square(honest) / honest_variance;
      square_honest += deviations2;
      constexpr double heavy_tail =
          3.0;  // Student's t, so that wrong pairs do not choose the field
      score -= 0.5 * exact::log(honest_variance * square(px_per_m)) +
               2.0 * exact::log(1.0 + deviations2 / heavy_tail);
    };
    add(0, place.noise.lateral_m, fit.noise_px[i].x);
    add(1, place.noise.upward_m, fit.noise_px[i].y);
    out.others_px.push_back(std::sqrt(square_px));
    out.deviations.push_back(std::sqrt(square_honest));
    out.square_deviations.push_back(square_deviations);
    out.scores.push_back(score);
    out.score += score;
  }
  return out;
}

PairJudgement refine_pairs(PairFit& fit, double sigma_px, int rounds) {
  fit.field.places = displaced_places(fit);
  PairJudgement best = judge_pairs(fit, sigma_px);
  for (int round = 0; round < rounds; ++round) {
    PairFit next = fit;
    next.view = refitted_view(fit, sigma_px);
    if (!is_plausible(fit.frame, next.view, fit.pairs)) break;
    next.field.places = displaced_places(next);
    PairJudgement judgement = judge_pairs(next, sigma_px);
    if (judgement.score < best.score) break;
    fit = std::move(next);
    best = std::move(judgement);
  }
  return best;
}

DisplacementParameters field_of_extent(double extent_m, double length) {
  constexpr double reach = 0.05, still = 0.0006, max = 0.04;
  return {length * extent_m, reach * extent_m, still * extent_m, max * extent_m, {}};
}

}  // namespace belvedere
