#include "terrain/register/registration.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/deform/deform.h"
#include "terrain/register/find_mountains.h"

namespace belvedere {
namespace {

glm::dvec2 eye_of(const PairFit& fit) {
  return fit.frame.origin + fit.frame.extent_m * glm::dvec2(fit.view[view_unknown::east],
                                                            fit.view[view_unknown::north]);
}

// Whether the ground at a position keeps its order.
bool keeps_order(const Deformation& with_field, const HandleField& handles, glm::dvec2 position,
                 double step_m) {
  constexpr double min_area = 0.2, max_fall = 0.8;
  const auto area = [&](auto&& moved) {
    const glm::dvec2 east(step_m, 0.0), north(0.0, step_m);
    const glm::dmat2 slope(moved(position + east) - moved(position - east),
                           moved(position + north) - moved(position - north));
    return glm::determinant(slope);
  };
  const double left =
      area([&](glm::dvec2 at) { return handles.is_identity() ? at : handles.move(at).position; });
  if (area([&](glm::dvec2 at) { return with_field.moved_in_plan(at); }) < min_area * left)
    return false;
  const glm::dvec2 line = position - with_field.viewer_xy();
  const double distance = exact::hypot(line.x, line.y);
  if (distance < step_m) return true;
  const glm::dvec2 away = (step_m / distance) * line;
  const double rise = with_field.field().at(position + away).upward_m -
                      with_field.field().at(position - away).upward_m;
  return rise >= -max_fall * 2.0 * step_m;
}

// Positions where the fit's ground would lose its order.
std::vector<glm::dvec2> folds_of(const PairFit& fit) {
  constexpr double nodes_to_a_length = 4.0, steps_to_a_node = 8.0;
  DeformParameters parameters;
  parameters.handles = handles_of(fit.mountains);
  parameters.field = fit.field;
  const Deformation deformation(parameters, eye_of(fit));
  glm::dvec2 low = fit.pairs.front().position, high = low;
  for (const ControlPair& pair : fit.pairs) {
    low = glm::min(low, pair.position);
    high = glm::max(high, pair.position);
  }
  const double node = std::min(fit.field.length_m, fit.field.reach_m) / nodes_to_a_length;
  const double margin = fit.field.reach_m;
  const glm::ivec2 count = glm::ivec2((high - low + 2.0 * margin) / node) + 1;
  std::vector<std::vector<glm::dvec2>> rows(static_cast<std::size_t>(count.y));
  parallel_rows(count.y, [&](int y) {
    for (int x = 0; x < count.x; ++x) {
      const glm::dvec2 at = low - margin + node * glm::dvec2(x, y);
      if (!keeps_order(deformation, deformation.handles(), at, node / steps_to_a_node))
        rows[static_cast<std::size_t>(y)].push_back(at);
    }
  });
  std::vector<glm::dvec2> out;
  for (const std::vector<glm::dvec2>& row : rows) out.insert(out.end(), row.begin(), row.end());
  return out;
}

// The place near a position that agrees least with the others, a sure one only if there is no
// other; nothing if none is near.
std::optional<std::size_t> doubtful_place(const PairFit& fit, const PairJudgement& judgement,
                                          glm::dvec2 position) {
  constexpr double near = 1.5;  // of length or reach
  constexpr double no_weight = 1e-4;
  const double limit = near * std::max(fit.field.length_m, fit.field.reach_m);
  std::optional<std::size_t> out;
  for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
    const glm::dvec2 line = fit.pairs[i].position - position;
    if (exact::hypot(line.x, line.y) > limit || fit.weights[i] < no_weight) continue;
    const auto doubt = [&](std::size_t k) {
      return std::pair(!fit.pairs[k].sure, judgement.square_deviations[k]);
    };
    if (!out || doubt(i) > doubt(*out)) out = i;
  }
  return out;
}

}  // namespace

std::vector<std::size_t> prevent_folds(PairFit& fit, double sigma_px) {
  constexpr int rounds = 24;
  constexpr double lighter = 0.1;
  fit.field.places = displaced_places(fit);
  std::set<std::size_t> out;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<glm::dvec2> folds = folds_of(fit);
    if (folds.empty()) break;
    const PairJudgement judgement = judge_pairs(fit, sigma_px);
    std::set<std::size_t> now;
    for (const glm::dvec2 fold : folds)
      if (const auto place = doubtful_place(fit, judgement, fold)) now.insert(*place);
    for (const std::size_t i : now) fit.weights[i] *= lighter;
    out.merge(now);
    fit.field.places = displaced_places(fit);
  }
  return {out.begin(), out.end()};
}

namespace {

namespace unknown = view_unknown;

constexpr double fitted_width_px = 1200.0;

void set_noise(PairFit& fit, double sigma_px) {
  fit.noise_px.assign(fit.pairs.size(), glm::dvec2(sigma_px));
  fit.weights.assign(fit.pairs.size(), 1.0);
}

// The length of the field, and the noise if it is not given, that leave-one-out finds likeliest.
struct Choice {
  double length = 0.0;  // in extents
  double sigma_px = 0.0;
};
Choice choose_field(const PairFit& fit, std::optional<double> sigma_px, Progress& progress) {
  constexpr double usual_px = 3.0, usual_spread = 0.2;  // of ln sigma
  const std::vector<double> sigmas =
      sigma_px ? std::vector{*sigma_px} : std::vector{1.5, 2.0, 3.0, 4.5, 6.5};
  Choice best;
  double best_score = -std::numeric_limits<double>::infinity();
  for (const double sigma : sigmas)
    for (const double length : {0.06, 0.12, 0.2}) {
      progress.advance(0.0);
      PairFit tried = fit;
      tried.field = field_of_extent(fit.frame.extent_m, length);
      set_noise(tried, sigma);
      const double score = refine_pairs(tried, sigma, 1).score -
                           0.5 * square(exact::log(sigma / usual_px) / usual_spread);
      if (score > best_score) best_score = score, best = {length, sigma};
    }
  return best;
}

double view_distance_px(const PairFit& fit, const ControlPair& pair) {
  const ViewPixel at = project_in_view(fit.frame, fit.view, pair.position, pair.altitude_m);
  return exact::hypot(at.u.value - pair.pixel.x, at.v.value - pair.pixel.y);
}

// Where the field and the view show a place.
glm::dvec2 predicted_pixel(const PairFit& fit, const DisplacementField& field,
                           const ControlPair& pair) {
  const ControlPair moved = moved_by(HandleField(handles_of(fit.mountains)), pair);
  const ViewPixel at = project_in_view(fit.frame, fit.view, moved.position, moved.altitude_m,
                                       field.at(pair.position));
  return {at.u.value, at.v.value};
}

void add_pair(WeighedPairs& fitted, const std::vector<ControlPair>& pairs, std::size_t index,
              double sigma_px) {
  const auto at = static_cast<std::ptrdiff_t>(fitted.index.size());
  fitted.fit.pairs.insert(fitted.fit.pairs.begin() + at, pairs[index]);
  fitted.fit.noise_px.insert(fitted.fit.noise_px.begin() + at, glm::dvec2(sigma_px));
  fitted.fit.weights.insert(fitted.fit.weights.begin() + at, 1.0);
  fitted.index.push_back(index);
}

// Pairs that were thrown out and agree now.
bool take_back(WeighedPairs& fitted, const std::vector<ControlPair>& pairs, double sigma_px) {
  constexpr double near_px = 14.0;
  const DisplacementField field(fitted.fit.field);
  bool any = false;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (std::find(fitted.index.begin(), fitted.index.end(), i) != fitted.index.end()) continue;
    const glm::dvec2 off = predicted_pixel(fitted.fit, field, pairs[i]) - pairs[i].pixel;
    if (exact::hypot(off.x, off.y) > near_px) continue;
    add_pair(fitted, pairs, i, sigma_px);
    any = true;
  }
  return any;
}

void take_result(Registration& out, const WeighedPairs& fitted,
                 const std::vector<ControlPair>& pairs) {
  PairFit fit = fitted.fit;
  for (PairFinding& finding : out.findings) finding.would_fold = false;
  const std::vector<std::size_t> held_back = prevent_folds(fit, out.sigma_px / out.scale);
  out.held_back = held_back.size();
  for (const std::size_t i : held_back)
    if (i < fitted.index.size()) out.findings[fitted.index[i]].would_fold = true;
  const DisplacementField field(fit.field);
  constexpr double near_by = 2.0;  // of the field's reach
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    PairFinding& finding = out.findings[i];
    finding.view_px = out.scale * view_distance_px(fit, pairs[i]);
    const glm::dvec2 off = predicted_pixel(fit, field, pairs[i]) - pairs[i].pixel;
    if (finding.wrong) finding.others_px = exact::hypot(off.x, off.y);
    finding.others_px *= out.scale;
    finding.nearest_m = std::numeric_limits<double>::infinity();
    finding.near_by = 0;
    for (std::size_t k = 0; k < fit.pairs.size(); ++k) {
      if (k < fitted.index.size() && fitted.index[k] == i) continue;
      const glm::dvec2 line = fit.pairs[k].position - pairs[i].position;
      const double distance = exact::hypot(line.x, line.y);
      finding.nearest_m = std::min(finding.nearest_m, distance);
      if (distance < near_by * fit.field.reach_m) ++finding.near_by;
    }
  }
  out.frame = fit.frame;
  out.view = fit.view;
  out.mountains = fit.mountains;
  out.displacement = fit.field;
  out.score = mean_score(fitted);
  out.view_covariance = view_covariance(fit, out.sigma_px / out.scale);
}

ViewPixel registered_view_pixel(const Registration& registration, const DisplacementField& field,
                                glm::dvec2 position, double altitude_m) {
  HandleField::Moved moved{position, 0.0};
  if (!registration.mountains.empty())
    moved = HandleField(handles_of(registration.mountains)).move(position);
  return project_in_view(registration.frame, registration.view, moved.position,
                         altitude_m + moved.raise_m, field.at(position));
}

std::vector<ControlPair> at_fitted_size(std::span<const ControlPair> given, double scale) {
  std::vector<ControlPair> pairs(given.begin(), given.end());
  for (ControlPair& pair : pairs) pair.pixel /= scale;
  return pairs;
}

// The pairs that were kept and places found in the paint, weighed as the registration has them.
WeighedPairs start_of(const Registration& registration, const std::vector<ControlPair>& pairs,
                      std::span<const PaintedPlace> painted) {
  const double sigma = registration.sigma_px / registration.scale;
  WeighedPairs start;
  start.fit.frame = registration.frame;
  start.fit.view = registration.view;
  start.fit.mountains = registration.mountains;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!registration.findings[i].wrong) add_pair(start, pairs, i, sigma);
  const DisplacementField field(registration.displacement);
  const HandleField handles(handles_of(registration.mountains));
  for (const PaintedPlace& match : painted) {
    ControlPair place = match.place;
    place.pixel /= registration.scale;
    const glm::dvec2 noise = glm::max(match.sigma_px / registration.scale, glm::dvec2(sigma));
    const glm::dvec2 off = predicted_pixel(start.fit, field, place) - place.pixel;
    const ViewDisplacement seen =
        displacement_in_view(start.fit.frame, start.fit.view, moved_by(handles, place));
    const Displacement unsure = field.deviation(place.position);
    const double deviations2 =
        square(off.x) / (square(unsure.lateral_m * seen.px_per_m.lateral_m) + square(noise.x)) +
        square(off.y) / (square(unsure.upward_m * seen.px_per_m.upward_m) + square(noise.y));
    start.fit.pairs.push_back(place);
    start.fit.noise_px.push_back(noise);
    start.fit.weights.push_back(weight_of(deviations2));
  }
  return start;
}

void check_sigma(std::optional<double> sigma_px) {
  if (sigma_px && !(*sigma_px >= 0.1 && *sigma_px <= 100.0))
    throw Error(ErrorKind::usage, "sigma_px", fmt::format("{}", *sigma_px), "0.1 to 100");
}

}  // namespace

Registration register_pairs(std::span<const ControlPair> given, glm::ivec2 painting_px,
                            const RegistrationParameters& parameters, Progress& progress) {
  check_sigma(parameters.sigma_px);
  if (given.size() < min_fitted_pairs)
    throw Error(ErrorKind::usage, "pairs", fmt::format("{} pairs", given.size()),
                fmt::format("{} or more", min_fitted_pairs));
  constexpr double cut_deviations = 5.0, cut_sigmas = 4.0, max_wrong = 0.25;
  constexpr int choose_every = 3;
  Registration out;
  out.scale = painting_px.x / fitted_width_px;
  std::vector<ControlPair> pairs(given.begin(), given.end());
  for (ControlPair& pair : pairs) pair.pixel /= out.scale;
  out.kinds = fit_views(pairs, glm::dvec2(painting_px) / out.scale, parameters.view, progress);
  PairFit fit{pairs, {}, {}, out.kinds.front().frame, out.kinds.front().view, {}, {}};
  std::vector<std::size_t> index;  // of fit.pairs in pairs
  for (std::size_t i = 0; i < pairs.size(); ++i) index.push_back(i);
  const std::optional<double> sigma =
      parameters.sigma_px ? std::optional(*parameters.sigma_px / out.scale) : std::nullopt;
  out.findings.resize(pairs.size());
  const auto max_thrown_out =
      static_cast<std::size_t>(max_wrong * static_cast<double>(pairs.size()));
  Choice choice;
  PairJudgement judgement;
  for (int round = 0;; ++round) {
    if (round % choose_every == 0) {
      choice = choose_field(fit, sigma, progress);
      fit.field = field_of_extent(fit.frame.extent_m, choice.length);
    }
    progress.advance(0.0);
    set_noise(fit, choice.sigma_px);
    judgement = refine_pairs(fit, choice.sigma_px, 2);
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
  out.sigma_px = out.scale * choice.sigma_px;
  take_result(out, {fit, index, judgement}, pairs);
  return out;
}

std::optional<Registration> refine_registration(const Registration& registration,
                                                std::span<const ControlPair> given,
                                                std::span<const PaintedPlace> painted) {
  const double sigma = registration.sigma_px / registration.scale;
  const std::vector<ControlPair> pairs = at_fitted_size(given, registration.scale);
  const WeighedPairs start = start_of(registration, pairs, painted);
  std::optional<WeighedPairs> best;
  for (const double length : {0.06, 0.12}) {
    WeighedPairs tried = start;
    tried.fit.field = field_of_extent(start.fit.frame.extent_m, length);
    constexpr int rounds = 4;
    weigh_by_agreement(tried, sigma, rounds);
    if (!is_plausible(tried.fit.frame, tried.fit.view, tried.fit.pairs)) continue;
    if (!best || tried.judgement.score > best->judgement.score) best = std::move(tried);
  }
  if (!best) return std::nullopt;
  // Limits of the loss of score, summed over the pairs; moving mountains gains less than
  // `hopeless`.
  constexpr double chance = 1.0, hopeless = 20.0;
  const auto loses = [&](double limit) {
    return mean_score(*best) < registration.score - limit / static_cast<double>(best->index.size());
  };
  if (loses(hopeless)) return std::nullopt;
  move_mountains(*best, sigma);
  if (loses(chance)) return std::nullopt;
  Registration out = registration;
  const double score = mean_score(*best);
  if (take_back(*best, pairs, sigma)) weigh_by_agreement(*best, sigma, 2);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    out.findings[i].wrong =
        std::find(best->index.begin(), best->index.end(), i) == best->index.end();
  for (std::size_t i = 0; i < best->index.size(); ++i) {
    PairFinding& finding = out.findings[best->index[i]];
    finding.others_px = best->judgement.others_px[i];
    finding.deviations = best->judgement.deviations[i];
  }
  take_result(out, *best, pairs);
  out.score = score;
  return out;
}

glm::dvec2 registered_pixel(const Registration& registration, const DisplacementField& field,
                            glm::dvec2 position, double altitude_m) {
  const ViewPixel at = registered_view_pixel(registration, field, position, altitude_m);
  return registration.scale * glm::dvec2(at.u.value, at.v.value);
}

double registered_sigma_px(const Registration& registration, const DisplacementField& field,
                           glm::dvec2 position, double altitude_m) {
  const ViewPixel at = registered_view_pixel(registration, field, position, altitude_m);
  const auto variance = [&](const ViewNumber& part) {
    double sum = 0.0;
    for (std::size_t i = 0; i < unknown::count; ++i)
      for (std::size_t k = 0; k < unknown::count; ++k)
        sum += part.slope[i] * registration.view_covariance(i, k) * part.slope[k];
    return sum;
  };
  const Displacement moved = field.deviation(position);
  const double px_per_m = exact::exp(registration.view[unknown::log_focal]) /
                          view_distance_m(registration.frame, registration.view, position);
  return registration.scale *
         std::sqrt(0.5 * (variance(at.u) + variance(at.v)) +
                   0.5 * square(px_per_m) * (square(moved.lateral_m) + square(moved.upward_m)));
}

}  // namespace belvedere
