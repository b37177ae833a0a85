#include "terrain/register/prevent_folds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <set>
#include <utility>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/deform/deform.h"

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

// Of the places near a position that of the least agreement, a sure one only if there is no other;
// nothing if none is near.
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

}  // namespace belvedere
