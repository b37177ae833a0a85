#include "terrain/deform/bend_curve.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"

namespace belvedere {

std::vector<double> monotone_tangents(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> run(n - 1);
  std::vector<double> rise(n - 1);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    run[k] = x[k + 1] - x[k];
    rise[k] = (y[k + 1] - y[k]) / run[k];
  }
  if (n == 2) return {rise[0], rise[0]};
  std::vector<double> tangent(n, 0.0);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    if (rise[k - 1] * rise[k] <= 0.0) continue;
    const double before = 2.0 * run[k] + run[k - 1];
    const double after = run[k] + 2.0 * run[k - 1];
    tangent[k] = (before + after) / (before / rise[k - 1] + after / rise[k]);
  }
  const auto at_end = [](double run_0, double run_1, double rise_0, double rise_1) {
    const double t = ((2.0 * run_0 + run_1) * rise_0 - run_0 * rise_1) / (run_0 + run_1);
    if (t * rise_0 <= 0.0) return 0.0;
    return rise_0 * rise_1 < 0.0 && std::abs(t) > 3.0 * std::abs(rise_0) ? 3.0 * rise_0 : t;
  };
  tangent.front() = at_end(run[0], run[1], rise[0], rise[1]);
  tangent.back() = at_end(run[n - 2], run[n - 3], rise[n - 2], rise[n - 3]);
  return tangent;
}

Cubic hermite(double run, double y0, double y1, double m0, double m1) {
  const double rise = (y1 - y0) / run;
  return {(3.0 * rise - 2.0 * m0 - m1) / run, (m0 + m1 - 2.0 * rise) / (run * run)};
}

MonotoneCurve::MonotoneCurve(std::vector<glm::dvec2> points) {
  if (points.empty()) return;
  last_ = points.back();
  if (points.size() == 1) return;
  std::vector<double> x, y;
  for (const glm::dvec2& point : points) x.push_back(point.x), y.push_back(point.y);
  const std::vector<double> tangent = monotone_tangents(x, y);
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    pieces_.push_back({x[k], y[k], tangent[k],
                       hermite(x[k + 1] - x[k], y[k], y[k + 1], tangent[k], tangent[k + 1])});
}

double MonotoneCurve::at(double x) const {
  if (pieces_.empty() || x >= last_.x) return last_.y;
  if (x <= pieces_.front().from) return pieces_.front().value;
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), x,
                                      [](double v, const Piece& piece) { return v < piece.from; });
  const Piece& piece = *(after - 1);
  const double t = x - piece.from;
  return piece.value + t * (piece.slope + t * (piece.cubic.square + t * piece.cubic.cube));
}

namespace {

void check_points(const BendCurve& curve) {
  const auto refuse = [](std::size_t i, const std::string& found, const char* allowed) {
    throw Error(ErrorKind::usage, fmt::format("points.{}", i), found, allowed);
  };
  if (curve.radius_m > 0.0 || curve.far_amount_per_m > 0.0)
    refuse(0, "control points together with radius_m or far_amount_per_m",
           "either control points or the parabola");
  if (curve.points.size() == 1) refuse(0, "a single control point", "at least two");
  const bool drops = curve.points.front().drop_m.has_value();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const BendPoint& point = curve.points[i];
    if (point.drop_m.has_value() == point.inclination_deg.has_value())
      refuse(
          i,
          point.drop_m ? "both drop_m and inclination_deg" : "neither drop_m nor inclination_deg",
          "exactly one of the two");
    if (point.drop_m.has_value() != drops)
      refuse(i, "drops and inclinations in one curve", "the same kind for all points");
    if (i > 0 && !(point.distance_m - curve.points[i - 1].distance_m >= 1.0))
      refuse(i, fmt::format("{} m after {} m", point.distance_m, curve.points[i - 1].distance_m),
             "distances in ascending order, at least 1 m apart");
  }
}

}  // namespace

BendProfile::BendProfile(const BendCurve& curve) : curve_(curve) {
  if (curve.points.empty()) return;
  check_points(curve);
  curve.points.front().drop_m ? join_drops(curve.points) : join_inclinations(curve.points);
}

void BendProfile::join_drops(const std::vector<BendPoint>& points) {
  std::vector<double> x;
  std::vector<double> y;
  for (const BendPoint& point : points) {
    x.push_back(point.distance_m);
    y.push_back(*point.drop_m);
  }
  const std::vector<double> tangent = monotone_tangents(x, y);
  pieces_.push_back({x[0], {y[0], tangent[0]}});
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    const Cubic c = hermite(x[k + 1] - x[k], y[k], y[k + 1], tangent[k], tangent[k + 1]);
    pieces_.push_back({x[k], {y[k], tangent[k], c.square, c.cube}});
  }
  pieces_.push_back({x.back(), {y.back(), tangent.back()}});
}

void BendProfile::join_inclinations(const std::vector<BendPoint>& points) {
  std::vector<double> x;
  std::vector<double> y;  // of drop', which is positive where the ground slopes away
  for (const BendPoint& point : points) {
    x.push_back(point.distance_m);
    y.push_back(-exact::tan(to_radians(*point.inclination_deg)));
  }
  const std::vector<double> tangent = monotone_tangents(x, y);
  pieces_.push_back({x[0], {0.0, y[0]}});
  double drop = 0.0;
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    const double run = x[k + 1] - x[k];
    const Cubic c = hermite(run, y[k], y[k + 1], tangent[k], tangent[k + 1]);
    pieces_.push_back({x[k], {drop, y[k], tangent[k] / 2.0, c.square / 3.0, c.cube / 4.0}});
    drop = drop_m(x[k + 1]);
  }
  pieces_.push_back({x.back(), {drop, y.back()}});
  const double highest = highest_drop();
  for (Piece& piece : pieces_) piece.drop[0] -= highest;
}

// The minimum drop between the first and the last point: at one of them, or where a piece is level.
// Slopes are monotone in each piece, so bisection finds it.
double BendProfile::highest_drop() const {
  double min = std::min(pieces_.front().drop[0], pieces_.back().drop[0]);
  for (std::size_t k = 1; k + 1 < pieces_.size(); ++k) {
    double low = pieces_[k].from;
    double high = pieces_[k + 1].from;
    min = std::min(min, pieces_[k].drop[0]);
    if (slope(low) * -pieces_[k + 1].drop[1] >= 0.0) continue;
    const bool rising = slope(low) > 0.0;
    for (int halving = 0; halving < 60; ++halving) {
      const double centre = 0.5 * (low + high);
      ((slope(centre) > 0.0) == rising ? low : high) = centre;
    }
    min = std::min(min, drop_m(low));
  }
  return min;
}

const BendProfile::Piece& BendProfile::piece(double distance_m) const {
  // Pieces 0 and 1 start at the same point: 0 extends back from it.
  std::size_t k = 0;
  while (k + 1 < pieces_.size() && distance_m >= pieces_[k + 1].from) ++k;
  return pieces_[k];
}

double BendProfile::drop_m(double distance_m) const {
  if (!pieces_.empty()) {
    const Piece& p = piece(distance_m);
    const double t = distance_m - p.from;
    return p.drop[0] + t * (p.drop[1] + t * (p.drop[2] + t * (p.drop[3] + t * p.drop[4])));
  }
  double drop = 0.0;
  if (curve_.radius_m > 0.0) {
    const double from_crest = distance_m - curve_.crest_m;
    drop += from_crest * from_crest / (2.0 * curve_.radius_m);
  }
  if (distance_m > curve_.far_from_m) {
    const double beyond = distance_m - curve_.far_from_m;
    drop += curve_.far_amount_per_m * beyond * beyond;
  }
  return drop;
}

double BendProfile::slope(double distance_m) const {
  if (!pieces_.empty()) {
    const Piece& p = piece(distance_m);
    const double t = distance_m - p.from;
    return -(p.drop[1] + t * (2.0 * p.drop[2] + t * (3.0 * p.drop[3] + t * 4.0 * p.drop[4])));
  }
  double fall = 0.0;
  if (curve_.radius_m > 0.0) fall += (distance_m - curve_.crest_m) / curve_.radius_m;
  if (distance_m > curve_.far_from_m)
    fall += 2.0 * curve_.far_amount_per_m * (distance_m - curve_.far_from_m);
  return -fall;
}

}  // namespace belvedere
