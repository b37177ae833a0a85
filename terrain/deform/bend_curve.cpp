#include "terrain/deform/bend_curve.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "terrain/deform/monotone_curve.h"

namespace belvedere {
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
