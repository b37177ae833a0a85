#include "terrain/register/pair_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"

namespace belvedere {

DeformHandle handle_of(const MovedMountain& mountain) {
  constexpr double centre = 0.03, radius = 0.11, radius_spread = 0.35, core = 0.4;
  constexpr double turn_deg = 25.0;
  constexpr double min_radius = 0.04, max_radius = 0.4, max_turn_deg = 170.0;
  // A core that moves by its belt's width / 1.9 folds the belt.
  constexpr double widths_to_fold = 1.9, max_of_fold = 0.95;
  const double extent = mountain.extent_m;
  const auto& x = mountain.at;
  DeformHandle out;
  out.centre = mountain.expected + centre * extent * glm::dvec2(x[0], x[1]);
  out.radius_m =
      extent * std::clamp(radius * exact::exp(std::clamp(radius_spread * x[2], -3.0, 3.0)),
                          min_radius, max_radius);
  out.core_m = core * out.radius_m;
  const double limit = max_of_fold * (out.radius_m - out.core_m) / widths_to_fold;
  const glm::dvec2 wanted = MovedMountain::move * extent * glm::dvec2(x[3], x[4]);
  out.move_m = wanted / std::sqrt(1.0 + (square(wanted.x) + square(wanted.y)) / square(limit));
  out.rotate_deg = std::clamp(turn_deg * x[5], -max_turn_deg, max_turn_deg);
  out.raise_m = MovedMountain::raise * extent * x[6];
  return out;
}

std::vector<DeformHandle> handles_of(std::span<const MovedMountain> mountains) {
  std::vector<DeformHandle> out;
  for (const MovedMountain& mountain : mountains) out.push_back(handle_of(mountain));
  return out;
}

bool are_apart(std::span<const DeformHandle> handles) {
  for (std::size_t i = 0; i < handles.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const glm::dvec2 line = handles[i].centre - handles[k].centre;
      if (exact::hypot(line.x, line.y) <= 1.01 * (handles[i].core_m + handles[k].core_m))
        return false;
    }
  return true;
}

namespace {

Cholesky factors_of(Matrix matrix, const char* what) {
  std::optional<Cholesky> factors = Cholesky::of(std::move(matrix));
  if (!factors) throw Error(ErrorKind::bug, what, "is not positive definite");
  return *std::move(factors);
}

Matrix sum(Matrix a, const Matrix& b, double factor) {
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t k = 0; k < a.columns(); ++k) a(i, k) += factor * b(i, k);
  return a;
}

}  // namespace

std::vector<LeftOut> leave_out(const Matrix& covariance, const Matrix& slopes,
                               const Matrix& precision, std::span<const double> residuals,
                               std::span<const std::vector<std::size_t>> groups) {
  const Cholesky factors = factors_of(covariance, "covariance");
  const std::vector<double> solved = factors.solve(residuals);
  // C⁻¹ by Woodbury's identity.
  const Matrix by_slopes = factors.solve(slopes);
  const Cholesky posterior =
      factors_of(sum(product(transposed(slopes), by_slopes), precision, 1.0), "precision");
  const Matrix inverse =
      sum(factors.inverse(), product(by_slopes, posterior.solve(transposed(by_slopes))), -1.0);
  std::vector<LeftOut> out;
  for (const std::vector<std::size_t>& group : groups) {
    Matrix block(group.size(), group.size());
    std::vector<double> of_group;
    for (std::size_t i = 0; i < group.size(); ++i) {
      of_group.push_back(solved[group[i]]);
      for (std::size_t k = 0; k < group.size(); ++k) block(i, k) = inverse(group[i], group[k]);
    }
    const Cholesky block_factors = factors_of(std::move(block), "observations");
    out.push_back({block_factors.solve(of_group), block_factors.inverse()});
  }
  return out;
}

namespace {

namespace unknown = view_unknown;

std::size_t count_unknowns(const PairFit& fit) {
  return unknown::count + MovedMountain::unknowns * fit.mountains.size();
}

// Derivatives by a mountain's unknowns, of the pairs that it moves. `slopes` has those by the eye,
// of which a move of the ground is the opposite.
void add_slopes_of_mountain(const PairFit& fit, std::size_t mountain, const HandleField& handles,
                            Matrix& slopes) {
  constexpr double step = 1e-3;  // of a deviation
  constexpr double farther = 1.2;
  const std::size_t n = fit.pairs.size();
  const DeformHandle& here = handles.handles()[mountain];
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 line = fit.pairs[i].position - here.centre;
    if (exact::hypot(line.x, line.y) < farther * here.radius_m) near.push_back(i);
  }
  for (std::size_t k = 0; k < MovedMountain::unknowns; ++k) {
    const auto stepped = [&](double by) {
      std::vector<MovedMountain> mountains = fit.mountains;
      mountains[mountain].at[k] += by;
      return HandleField(handles_of(mountains));
    };
    const HandleField ahead = stepped(step), behind = stepped(-step);
    const std::size_t column = unknown::count + MovedMountain::unknowns * mountain + k;
    for (const std::size_t i : near) {
      const glm::dvec2 at = fit.pairs[i].position;
      const HandleField::Moved a = ahead.move(at), b = behind.move(at);
      const glm::dvec2 moved = (a.position - b.position) / (2.0 * step * fit.frame.extent_m);
      const double raised = (a.raise_m - b.raise_m) / (2.0 * step);
      for (const std::size_t row : {i, n + i})
        slopes(row, column) =
            -slopes(row, unknown::east) * moved.x - slopes(row, unknown::north) * moved.y;
      const double distance = view_distance_m(fit.frame, fit.view, handles.move(at).position);
      slopes(n + i, column) -= view_exaggeration(fit.frame, fit.view, distance) * raised;
    }
  }
}

}  // namespace

Residuals displacements(const PairFit& fit) {
  const std::size_t n = fit.pairs.size();
  Residuals out{std::vector<double>(2 * n), Matrix(2 * n, count_unknowns(fit))};
  const HandleField handles(handles_of(fit.mountains));
  for (std::size_t i = 0; i < n; ++i) {
    const ViewDisplacement seen =
        displacement_in_view(fit.frame, fit.view, moved_by(handles, fit.pairs[i]));
    const auto set = [&](std::size_t row, const ViewNumber& value) {
      out.values[row] = value.value;
      std::copy(value.slope.begin(), value.slope.end(), out.slopes.row(row).begin());
    };
    set(i, seen.lateral_m);
    set(n + i, seen.upward_m);
  }
  for (std::size_t i = 0; i < fit.mountains.size(); ++i)
    add_slopes_of_mountain(fit, i, handles, out.slopes);
  return out;
}

namespace {

std::vector<double> unknowns_of(const PairFit& fit) {
  std::vector<double> out(fit.view.begin(), fit.view.end());
  for (const MovedMountain& mountain : fit.mountains)
    out.insert(out.end(), mountain.at.begin(), mountain.at.end());
  return out;
}

PairFit with_unknowns(PairFit fit, std::span<const double> at) {
  std::copy_n(at.begin(), unknown::count, fit.view.begin());
  for (std::size_t i = 0; i < fit.mountains.size(); ++i)
    std::copy_n(
        at.begin() + static_cast<std::ptrdiff_t>(unknown::count + MovedMountain::unknowns * i),
        MovedMountain::unknowns, fit.mountains[i].at.begin());
  return fit;
}

// Covariance of displacements(): that of the field, and that of clicked pixels.
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

// Inverse covariance of the unknowns before there are pairs.
Matrix prior_precision(const PairFit& fit, double sigma_px) {
  const std::size_t count = count_unknowns(fit);
  Matrix precision(count, count);
  constexpr double min_precision = 1e-4;
  for (const ViewNumber& prior : view_priors(fit.frame, fit.view)) {
    const ViewNumber scaled = weighed(prior, sigma_px);
    for (std::size_t i = 0; i < unknown::count; ++i)
      for (std::size_t k = 0; k < unknown::count; ++k)
        precision(i, k) += scaled.slope[i] * scaled.slope[k];
  }
  for (std::size_t i = 0; i < unknown::count; ++i) precision(i, i) += min_precision;
  for (std::size_t i = unknown::count; i < count; ++i) precision(i, i) += 1.0;
  return precision;
}

}  // namespace

ControlPair moved_by(const HandleField& handles, ControlPair pair) {
  if (handles.is_identity()) return pair;
  const HandleField::Moved moved = handles.move(pair.position);
  pair.position = moved.position;
  pair.altitude_m += moved.raise_m;
  return pair;
}

std::vector<DisplacedPlace> displaced_places(const PairFit& fit) {
  std::vector<DisplacedPlace> places;
  const HandleField handles(handles_of(fit.mountains));
  for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
    const ViewDisplacement seen =
        displacement_in_view(fit.frame, fit.view, moved_by(handles, fit.pairs[i]));
    const glm::dvec2 noise_px = fit.noise_px[i] / std::sqrt(fit.weights[i]);
    places.push_back({fit.pairs[i].position,
                      {seen.lateral_m.value, seen.upward_m.value},
                      {noise_px.x / seen.px_per_m.lateral_m, noise_px.y / seen.px_per_m.upward_m}});
  }
  return places;
}

std::optional<PairFit> refitted(const PairFit& fit, double sigma_px) {
  const Cholesky factors = factors_of_pairs(fit.field);
  const std::size_t count = count_unknowns(fit);
  const auto residuals = [&](std::span<const double> at) {
    const PairFit there = with_unknowns(fit, at);
    if (!are_apart(handles_of(there.mountains)))
      return Residuals{{std::numeric_limits<double>::quiet_NaN()}, Matrix(1, count)};
    const Residuals moved = displacements(there);
    const std::vector<double> white = factors.whitened(moved.values);
    const Matrix slopes = factors.whitened(moved.slopes);
    const std::vector<ViewNumber> priors = view_priors(fit.frame, there.view);
    Residuals out{white, Matrix(white.size() + priors.size() + count - unknown::count, count)};
    for (std::size_t i = 0; i < white.size(); ++i)
      std::copy(slopes.row(i).begin(), slopes.row(i).end(), out.slopes.row(i).begin());
    for (const ViewNumber& expected : priors) {
      const ViewNumber prior = weighed(expected, sigma_px);
      std::copy(prior.slope.begin(), prior.slope.end(), out.slopes.row(out.values.size()).begin());
      out.values.push_back(prior.value);
    }
    for (std::size_t k = unknown::count; k < count; ++k) {
      out.slopes(out.values.size(), k) = 1.0;
      out.values.push_back(at[k]);
    }
    return out;
  };
  constexpr int steps = 15;
  const LeastSquaresFit found =
      fit_least_squares(unknowns_of(fit), residuals, {.max_steps = steps, .tolerance = 1e-8});
  PairFit out = with_unknowns(fit, found.at);
  if (!is_plausible(out.frame, out.view, out.pairs)) return std::nullopt;
  out.field.places = displaced_places(out);
  return out;
}

Matrix view_covariance(const PairFit& fit, double sigma_px) {
  Matrix precision = normal_matrix(factors_of_pairs(fit.field).whitened(displacements(fit).slopes));
  const Matrix prior = prior_precision(fit, sigma_px);
  for (std::size_t i = 0; i < precision.rows(); ++i)
    for (std::size_t k = 0; k < precision.rows(); ++k) precision(i, k) += prior(i, k);
  const std::optional<Cholesky> factors = Cholesky::of(std::move(precision));
  if (!factors) throw Error(ErrorKind::bug, "registration", "no view is likely");
  return factors->inverse();
}

PairJudgement judge_pairs(const PairFit& fit, double sigma_px) {
  const std::size_t n = fit.pairs.size();
  const Residuals moved = displacements(fit);
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
      // Student's t, so that wrong pairs do not choose the field; of the noise without its weight,
      // so that weights have no part in it.
      constexpr double heavy_tail = 3.0;
      const double scored_variance =
          square(size_by_others) * share + square(noise_m) * fit.weights[i];
      score -= 0.5 * exact::log(scored_variance * square(px_per_m)) +
               2.0 * exact::log(1.0 + square(honest) / scored_variance / heavy_tail);
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
    std::optional<PairFit> next = refitted(fit, sigma_px);
    if (!next) break;
    PairJudgement judgement = judge_pairs(*next, sigma_px);
    if (judgement.score < best.score) break;
    fit = *std::move(next);
    best = std::move(judgement);
  }
  return best;
}

DisplacementParameters field_of_extent(double extent_m, double length) {
  constexpr double reach = 0.05, still = 0.0006, max = 0.04;
  return {length * extent_m, reach * extent_m, still * extent_m, max * extent_m, {}};
}

double mean_score(const WeighedPairs& weighed) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weighed.index.size(); ++i) sum += weighed.judgement.scores[i];
  return sum / static_cast<double>(weighed.index.size());
}

double weight_of(double square_deviations) {
  constexpr double freedom = 4.0, hopeless = 30.0, hardly_any = 0.01;
  if (square_deviations > hopeless) return hardly_any;
  return std::min((freedom + 2.0) / (freedom + square_deviations), 1.0);
}

void weigh_by_agreement(WeighedPairs& weighed, double sigma_px, int rounds) {
  constexpr double min_weight_of_pairs = 0.25;
  PairFit fit = weighed.fit;
  fit.field.places = displaced_places(fit);
  double best_score = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    if (std::optional<PairFit> next = refitted(fit, sigma_px)) fit = *std::move(next);
    PairJudgement judgement = judge_pairs(fit, sigma_px);
    const std::vector<double> square_deviations = judgement.square_deviations;
    if (judgement.score > best_score) {
      best_score = judgement.score;
      weighed.fit = fit;
      weighed.judgement = std::move(judgement);
    }
    for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
      const double weight = weight_of(square_deviations[i]);
      fit.weights[i] = i < weighed.index.size() ? std::max(weight, min_weight_of_pairs) : weight;
    }
    fit.field.places = displaced_places(fit);
  }
}

}  // namespace belvedere
