#include "terrain/register/fit_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/math_exact.h"
#include "base/matrix/matrix.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

namespace unknown = view_unknown;

constexpr double far_off_px = 60.0;  // residuals count up to this

double mean_up_to_far(const std::vector<double>& residuals_px) {
  double sum = 0.0;
  for (const double r : residuals_px) sum += std::min(std::abs(r), far_off_px);
  return sum / static_cast<double>(residuals_px.size());
}

// A view to start from.
struct Start {
  ViewUnknowns view = {};
  double cost_px = 0.0;
};

// The pairs' azimuths from an eye, about their mean direction; nothing if the eye stands among
// them or sees them all around.
struct Azimuths {
  double mean = 0.0;
  std::vector<double> turn;
};
std::optional<Azimuths> azimuths_from(glm::dvec2 eye, const ViewFrame& frame,
                                      std::span<const ControlPair> pairs) {
  constexpr double nearest = 0.04, widest = 4.5;  // of L; rad
  glm::dvec2 sum(0.0);
  std::vector<double> azimuth;
  for (const ControlPair& pair : pairs) {
    const glm::dvec2 line = pair.position - eye;
    const double distance = exact::hypot(line.x, line.y);
    if (distance < nearest * frame.extent_m) return std::nullopt;
    sum += line / distance;
    azimuth.push_back(exact::atan2(line.x, line.y));
  }
  Azimuths out{exact::atan2(sum.x, sum.y), {}};
  for (const double a : azimuth)
    out.turn.push_back(std::remainder(a - out.mean, 2.0 * std::numbers::pi));
  const auto [low, high] = std::minmax_element(out.turn.begin(), out.turn.end());
  return *high - *low > widest ? std::nullopt : std::optional(std::move(out));
}

// A cylinder's azimuth and focal length for an eye: the line of azimuths on columns, by the median
// of slopes (Theil 1950, Sen 1968).
std::optional<Start> cylinder_from(glm::dvec2 eye, const ViewFrame& frame,
                                   std::span<const ControlPair> pairs) {
  const std::optional<Azimuths> azimuths = azimuths_from(eye, frame, pairs);
  if (!azimuths) return std::nullopt;
  constexpr double apart = 0.06;      // of the width: pairs of pairs nearer than that tell no slope
  constexpr double shortest = 0.125;  // focal length in widths: 460°
  const double width = frame.size_px.x;
  std::vector<double> slopes;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t k = i + 1; k < pairs.size(); ++k) {
      const double run = pairs[k].pixel.x - pairs[i].pixel.x;
      if (std::abs(run) > apart * width)
        slopes.push_back((azimuths->turn[k] - azimuths->turn[i]) / run);
    }
  if (slopes.empty()) return std::nullopt;
  const double focal = 1.0 / median(std::move(slopes));
  if (!(focal > shortest * width) || !std::isfinite(focal)) return std::nullopt;
  std::vector<double> offset;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    offset.push_back(pairs[i].pixel.x - focal * azimuths->turn[i]);
  const double middle = median(offset);
  for (double& residual : offset) residual -= middle;
  Start start;
  start.view[unknown::east] = (eye.x - frame.origin.x) / frame.extent_m;
  start.view[unknown::north] = (eye.y - frame.origin.y) / frame.extent_m;
  start.view[unknown::azimuth] = azimuths->mean + (0.5 * width - middle) / focal;
  start.view[unknown::log_focal] = exact::log(focal);
  start.cost_px = mean_up_to_far(offset);
  return start;
}

// Adds e0, e1, D0, D1, D2, in which the rows are linear: least absolute deviations by iterated
// weights. False if no upright ground results.
bool add_tangents(Start& start, const ViewFrame& frame, std::span<const ControlPair> pairs) {
  constexpr std::array<std::size_t, 5> used = {0, 1, 3, 4, 5};  // of tangent_factors
  constexpr int rounds = 12;
  constexpr double floor_px = 2.0, ridge = 1e-6, min_exaggeration = 0.3;
  const double focal = exact::exp(start.view[unknown::log_focal]);
  const std::size_t n = pairs.size();
  // Two more rows keep e0 near 1.5 and e1 near 0.
  Matrix factors(n + 2, used.size());
  std::vector<double> rows(n + 2, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const double distance = view_distance_m(frame, start.view, pairs[i].position);
    const std::array<double, 9> all = tangent_factors(frame, distance, pairs[i].altitude_m);
    for (std::size_t k = 0; k < used.size(); ++k) factors(i, k) = focal * all[used[k]];
    rows[i] = 0.5 * frame.size_px.y - pairs[i].pixel.y;
  }
  factors(n, 1) = 60.0;
  factors(n + 1, 0) = 40.0;
  rows[n + 1] = 60.0;
  std::vector<double> weights(n + 2, 1.0), found, residuals = rows;
  for (int round = 0; round < rounds; ++round) {
    Matrix scaled = factors;
    std::vector<double> aims = rows;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double root = std::sqrt(weights[i]);
      for (double& v : scaled.row(i)) v *= root;
      aims[i] *= root;
    }
    Matrix normal = normal_matrix(scaled);
    double trace = 0.0;
    for (std::size_t k = 0; k < used.size(); ++k) trace += normal(k, k);
    for (std::size_t k = 0; k < used.size(); ++k) normal(k, k) += ridge * trace;
    const std::optional<Cholesky> solver = Cholesky::of(std::move(normal));
    if (!solver) return false;
    found = solver->solve(product_transposed(scaled, aims));
    const std::vector<double> fitted = product(factors, found);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      residuals[i] = rows[i] - fitted[i];
      weights[i] = 1.0 / std::max(std::abs(residuals[i]), floor_px);
    }
  }
  if (found[0] < min_exaggeration) return false;
  for (std::size_t k = 0; k < used.size(); ++k)
    start.view[unknown::exaggeration + used[k]] = found[k];
  residuals.resize(n);
  start.cost_px += mean_up_to_far(residuals);
  return true;
}

void sort_starts(std::vector<Start>& starts) {
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.cost_px < b.cost_px; });
}

// The best views of a cylinder from eyes on a lattice, some distance apart.
std::vector<Start> find_starts(const ViewFrame& frame, std::span<const ControlPair> pairs) {
  constexpr int lattice = 26;
  constexpr double reach = 1.5, apart = 0.08;  // of L
  constexpr std::size_t with_rows = 160, kept = 8;
  glm::dvec2 low = pairs.front().position, high = low;
  for (const ControlPair& pair : pairs) {
    low = {std::min(low.x, pair.position.x), std::min(low.y, pair.position.y)};
    high = {std::max(high.x, pair.position.x), std::max(high.y, pair.position.y)};
  }
  std::vector<Start> starts;
  for (int i = 0; i < lattice; ++i)
    for (int k = 0; k < lattice; ++k) {
      const glm::dvec2 from(2.0 * i / (lattice - 1) - 1.0, 2.0 * k / (lattice - 1) - 1.0);
      const glm::dvec2 eye = 0.5 * (low + high) + reach * frame.extent_m * from;
      if (const std::optional<Start> start = cylinder_from(eye, frame, pairs))
        starts.push_back(*start);
    }
  sort_starts(starts);
  if (starts.size() > with_rows) starts.resize(with_rows);
  std::erase_if(starts, [&](Start& start) { return !add_tangents(start, frame, pairs); });
  sort_starts(starts);
  std::vector<Start> best;
  for (const Start& start : starts) {
    const bool alone = std::none_of(best.begin(), best.end(), [&](const Start& other) {
      return exact::hypot(start.view[unknown::east] - other.view[unknown::east],
                          start.view[unknown::north] - other.view[unknown::north]) <= apart;
    });
    if (alone && best.size() < kept) best.push_back(start);
  }
  return best;
}

FittedView fit_from(const Start& start, const ViewFrame& frame,
                    std::span<const ControlPair> pairs) {
  constexpr double scale_px = 6.0, largest_px = 3000.0, first_pitch = -0.25;
  // One deviation of the priors weighs like so many pixels.
  constexpr double prior_px = 2.0;
  std::vector<double> first(start.view.begin(), start.view.end());
  if (frame.kind != ViewKind::cylinder) {
    first[unknown::pitch] = first_pitch;
    first[unknown::drop + 1] -= exact::tan(first_pitch);
  }
  const auto residuals = [&](std::span<const double> at) {
    ViewUnknowns view;
    std::copy(at.begin(), at.end(), view.begin());
    std::vector<ViewNumber> rows;
    const auto add_px = [&](const ViewNumber& projected, double painted) {
      const ViewNumber off = projected - ViewNumber(painted);
      rows.push_back(std::abs(off.value) < largest_px
                         ? off / ViewNumber(scale_px)
                         : ViewNumber(std::copysign(largest_px / scale_px, off.value)));
    };
    for (const ControlPair& pair : pairs) {
      const ViewPixel pixel = project_in_view(frame, view, pair.position, pair.altitude_m);
      add_px(pixel.u, pair.pixel.x);
      add_px(pixel.v, pair.pixel.y);
    }
    for (const ViewNumber& prior : view_priors(frame, view))
      rows.push_back(prior * ViewNumber(prior_px / scale_px));
    Residuals out{std::vector<double>(rows.size()), Matrix(rows.size(), unknown::count)};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      out.values[i] = rows[i].value;
      std::copy(rows[i].slope.begin(), rows[i].slope.end(), out.slopes.row(i).begin());
    }
    return out;
  };
  const LeastSquaresFit fit =
      fit_least_squares(std::move(first), residuals, {.robust = 2 * pairs.size()});
  FittedView out{.frame = frame, .view = {}, .cost = fit.cost, .median_px = 0.0};
  std::copy(fit.at.begin(), fit.at.end(), out.view.begin());
  std::vector<double> distances;
  for (const ControlPair& pair : pairs) {
    const ViewPixel pixel = project_in_view(frame, out.view, pair.position, pair.altitude_m);
    distances.push_back(exact::hypot(pixel.u.value - pair.pixel.x, pixel.v.value - pair.pixel.y));
  }
  out.median_px = median(std::move(distances));
  return out;
}

}  // namespace

std::vector<FittedView> fit_views(std::span<const ControlPair> pairs, glm::dvec2 size_px,
                                  const FitViewParameters& parameters, Progress& progress) {
  ViewFrame frame = view_frame(ViewKind::cylinder, size_px, parameters.cropped, pairs);
  const std::vector<Start> starts = find_starts(frame, pairs);
  std::vector<FittedView> views;
  for (const ViewKind kind : parameters.kinds) {
    frame.kind = kind;
    std::optional<FittedView> best;
    for (const Start& start : starts) {
      progress.advance(0.0);
      FittedView fitted = fit_from(start, frame, pairs);
      if (!is_plausible(frame, fitted.view, pairs)) continue;
      if (!best || fitted.cost < best->cost) best = std::move(fitted);
    }
    if (best) views.push_back(*best);
  }
  if (views.empty())
    throw Error(ErrorKind::input, "pairs", "no view shows these places at these pixels",
                "x_px to the right and y_px down from the top left; longitude before latitude; "
                "pairs spread over the painting");
  std::stable_sort(views.begin(), views.end(),
                   [](const FittedView& a, const FittedView& b) { return a.cost < b.cost; });
  return views;
}

}  // namespace belvedere
