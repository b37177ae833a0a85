#include "terrain/register/registration.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/matrix/least_squares.h"
#include "terrain/register/leave_out.h"

namespace belvedere {
namespace {

namespace unknown = view_unknown;

constexpr double fitted_width_px = 1200.0;

// The pairs that count, and a view and a field for them.
struct Fit {
  std::vector<ControlPair> pairs;
  ViewFrame frame;
  ViewUnknowns view = {};
  DisplacementParameters field;  // its places are the pairs, in their order
};

// What a view leaves to the field.
std::vector<DisplacedPlace> displaced_places(const Fit& fit, double sigma_px) {
  std::vector<DisplacedPlace> places;
  for (const ControlPair& pair : fit.pairs) {
    const ViewDisplacement seen = displacement_in_view(fit.frame, fit.view, pair);
    places.push_back({pair.position,
                      {seen.lateral_m.value, seen.upward_m.value},
                      {sigma_px / seen.px_per_m.lateral_m, sigma_px / seen.px_per_m.upward_m}});
  }
  return places;
}

// Residuals, lateral then upward, and their derivatives by the view.
Residuals displacements(const Fit& fit, const ViewUnknowns& view) {
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

// The view that is most likely under the field's covariance.
ViewUnknowns refitted_view(const Fit& fit, double sigma_px) {
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

// How the field and the view explain the pairs.
struct Judgement {
  std::vector<LeftOut> left_out;   // lateral, upward of each pair, m
  std::vector<double> others_px;   // distance of a pair from where the others say it is
  std::vector<double> deviations;  // the same in standard deviations, without its own size
  double score = 0.0;              // ln of how likely each pair is by the others
};

Judgement judge(const Fit& fit, double sigma_px) {
  const std::size_t n = fit.pairs.size();
  const Residuals moved = displacements(fit, fit.view);
  // The model's own derivatives are those of observed minus modelled, reversed; the sign has no
  // effect.
  Matrix precision(unknown::count, unknown::count);
  constexpr double min_precision = 1e-4;
  for (const ViewNumber& prior : view_priors(fit.frame, fit.view)) {
    const ViewNumber scaled = weighed(prior, sigma_px);
    for (std::size_t i = 0; i < unknown::count; ++i)
      for (std::size_t k = 0; k < unknown::count; ++k)
        precision(i, k) += scaled.slope[i] * scaled.slope[k];
  }
  for (std::size_t i = 0; i < unknown::count; ++i) precision(i, i) += min_precision;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < n; ++i) groups.push_back({i, n + i});
  Judgement out;
  out.left_out =
      leave_out(whole_covariance(fit.field), moved.slopes, precision, moved.values, groups);
  for (std::size_t i = 0; i < n; ++i) {
    const DisplacedPlace& place = fit.field.places[i];
    const double size = displacement_size_m(fit.field, place.position);
    const double size_by_others = displacement_size_m(fit.field, place.position, i);
    double square_px = 0.0, square_deviations = 0.0;
    const auto add = [&](std::size_t part, double noise_m) {
      const double px_per_m = sigma_px / noise_m;
      const double residual = out.left_out[i].residuals[part];
      const double variance = out.left_out[i].covariance(part, part);
      square_px += square(residual * px_per_m);
      // A pair must not vouch for itself: the same if its ground had the size that others give it.
      const double share = std::max(variance - square(noise_m), 0.0) / square(size);
      const double observed = part == 0 ? moved.values[i] : moved.values[n + i];
      const double honest = observed - (observed - residual) * size_by_others / size;
      const double honest_variance = square(size_by_others) * share + square(noise_m);
      const double deviations2 = square(honest) / honest_variance;
      square_deviations += deviations2;
      constexpr double heavy_tail =
          3.0;  // Student's t, so that wrong pairs do not choose the field
      out.score -= 0.5 * exact::log(honest_variance * square(px_per_m)) +
                   2.0 * exact::log(1.0 + deviations2 / heavy_tail);
    };
    add(0, place.noise.lateral_m);
    add(1, place.noise.upward_m);
    out.others_px.push_back(std::sqrt(square_px));
    out.deviations.push_back(std::sqrt(square_deviations));
  }
  return out;
}

// Field and view in turn, as long as the others tell each pair no worse: a view that leaves much to
// the field is free to leave it more.
Judgement refine(Fit& fit, double sigma_px, int rounds) {
  fit.field.places = displaced_places(fit, sigma_px);
  Judgement best = judge(fit, sigma_px);
  for (int round = 0; round < rounds; ++round) {
    Fit next = fit;
    next.view = refitted_view(fit, sigma_px);
    if (!is_plausible(fit.frame, next.view, fit.pairs)) break;
    next.field.places = displaced_places(next, sigma_px);
    Judgement judgement = judge(next, sigma_px);
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

// The length of the field, and the noise if it is not given, that leave-one-out finds likeliest.
struct Choice {
  double length = 0.0;  // in extents
  double sigma_px = 0.0;
};
Choice choose_field(const Fit& fit, std::optional<double> sigma_px) {
  constexpr double usual_px = 3.0, usual_spread = 0.2;  // of ln sigma
  const std::vector<double> sigmas =
      sigma_px ? std::vector{*sigma_px} : std::vector{1.5, 2.0, 3.0, 4.5, 6.5};
  Choice best;
  double best_score = -std::numeric_limits<double>::infinity();
  for (const double sigma : sigmas)
    for (const double length : {0.06, 0.12, 0.2}) {
      Fit tried = fit;
      tried.field = field_of_extent(fit.frame.extent_m, length);
      const double score =
          refine(tried, sigma, 1).score - 0.5 * square(exact::log(sigma / usual_px) / usual_spread);
      if (score > best_score) best_score = score, best = {length, sigma};
    }
  return best;
}

double view_distance_px(const Fit& fit, const ControlPair& pair) {
  const ViewPixel at = project_in_view(fit.frame, fit.view, pair.position, pair.altitude_m);
  return exact::hypot(at.u.value - pair.pixel.x, at.v.value - pair.pixel.y);
}

// Where the field and the view show a place.
glm::dvec2 predicted_pixel(const Fit& fit, const DisplacementField& field,
                           const ControlPair& pair) {
  const ViewPixel at =
      project_in_view(fit.frame, fit.view, pair.position, pair.altitude_m, field.at(pair.position));
  return {at.u.value, at.v.value};
}

void check_sigma(std::optional<double> sigma_px) {
  if (sigma_px && !(*sigma_px >= 0.1 && *sigma_px <= 100.0))
    throw Error(ErrorKind::usage, "sigma_px", fmt::format("{}", *sigma_px), "0.1 to 100");
}

}  // namespace

Registration register_pairs(std::span<const ControlPair> given, glm::ivec2 painting_px,
                            const RegistrationParameters& parameters) {
  check_sigma(parameters.sigma_px);
  constexpr double cut_deviations = 5.0, cut_sigmas = 4.0, max_wrong = 0.25;
  constexpr int choose_every = 3;
  Registration out;
  out.scale = painting_px.x / fitted_width_px;
  std::vector<ControlPair> pairs(given.begin(), given.end());
  for (ControlPair& pair : pairs) pair.pixel /= out.scale;
  out.kinds = fit_views(pairs, glm::dvec2(painting_px) / out.scale, parameters.view);
  Fit fit{pairs, out.kinds.front().frame, out.kinds.front().view, {}};
  std::vector<std::size_t> index;  // of fit.pairs in pairs
  for (std::size_t i = 0; i < pairs.size(); ++i) index.push_back(i);
  const std::optional<double> sigma =
      parameters.sigma_px ? std::optional(*parameters.sigma_px / out.scale) : std::nullopt;
  out.findings.resize(pairs.size());
  const auto max_thrown_out =
      static_cast<std::size_t>(max_wrong * static_cast<double>(pairs.size()));
  Choice choice;
  Judgement judgement;
  for (int round = 0;; ++round) {
    if (round % choose_every == 0) {
      choice = choose_field(fit, sigma);
      fit.field = field_of_extent(fit.frame.extent_m, choice.length);
    }
    judgement = refine(fit, choice.sigma_px, 2);
    const auto is_far_off = [&](std::size_t i) {
      return judgement.deviations[i] > cut_deviations &&
             judgement.others_px[i] > cut_sigmas * choice.sigma_px;
    };
    std::optional<std::size_t> worst;
    for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
      PairFinding& finding = out.findings[index[i]];
      finding.others_px = judgement.others_px[i];
      finding.deviations = judgement.deviations[i];
      finding.doubted = is_far_off(i) && fit.pairs[i].sure;
      if (is_far_off(i) && !fit.pairs[i].sure &&
          (!worst || judgement.deviations[i] > judgement.deviations[*worst]))
        worst = i;
    }
    if (!worst || pairs.size() - fit.pairs.size() >= max_thrown_out) break;
    out.findings[index[*worst]].wrong = true;
    fit.pairs.erase(fit.pairs.begin() + static_cast<std::ptrdiff_t>(*worst));
    index.erase(index.begin() + static_cast<std::ptrdiff_t>(*worst));
  }
  const DisplacementField field(fit.field);
  constexpr double near_by = 2.0;  // of the field's reach
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    PairFinding& finding = out.findings[i];
    finding.view_px = out.scale * view_distance_px(fit, pairs[i]);
    const glm::dvec2 off = predicted_pixel(fit, field, pairs[i]) - pairs[i].pixel;
    if (finding.wrong) finding.others_px = exact::hypot(off.x, off.y);
    finding.others_px *= out.scale;
    finding.nearest_m = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < fit.pairs.size(); ++k) {
      if (index[k] == i) continue;
      const glm::dvec2 line = fit.pairs[k].position - pairs[i].position;
      const double distance = exact::hypot(line.x, line.y);
      finding.nearest_m = std::min(finding.nearest_m, distance);
      if (distance < near_by * fit.field.reach_m) ++finding.near_by;
    }
  }
  out.frame = fit.frame;
  out.view = fit.view;
  out.displacement = fit.field;
  out.sigma_px = out.scale * choice.sigma_px;
  return out;
}

glm::dvec2 registered_pixel(const Registration& registration, const DisplacementField& field,
                            glm::dvec2 position, double altitude_m) {
  const ViewPixel at = project_in_view(registration.frame, registration.view, position, altitude_m,
                                       field.at(position));
  return registration.scale * glm::dvec2(at.u.value, at.v.value);
}

}  // namespace belvedere
