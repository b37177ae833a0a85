#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace belvedere {

// A control point of a bend: how far the ground sinks there, or its inclination; one of the two.
struct BendPoint {
  double distance_m = 0.0;                // from the viewer, 0…1e8
  std::optional<double> drop_m;           // positive is down, -1e6…1e6
  std::optional<double> inclination_deg;  // of the level plain, -80…80: positive towards the
                                          // viewer, 0 level, negative away
};

// Progressive bending: the foreground is tilted towards the viewer like a map, the far ground sinks
// to the horizon. Either the parabola drop = (d - crest)² / (2 radius) + [d > far_from] far_amount
// (d - far_from)², d the horizontal distance from the viewer. It curves a level plain downwards by
// 1 / radius everywhere and by 2 far_amount more beyond far_from, where height and slope are
// continuous. Or a curve through control points:
//   - of drops: the monotone cubic of Fritsch & Butland (1984), C1, which does not overshoot;
//   - of inclinations: the same through their tangents, integrated, so C2; the drop counts from the
//     curve's highest point.
// Before the first and after the last point the inclination is constant.
struct BendCurve {
  double radius_m = 0.0;          // 0: no parabola; else 1000…1e9
  double crest_m = 0.0;           // distance where the ground is level
  double far_from_m = 0.0;        // ≥ 0
  double far_amount_per_m = 0.0;  // ≥ 0, 1/m
  std::vector<BendPoint> points =
      {};  // none, or two and more by distance, all with drops or all with inclinations
};

// A bend prepared for fast evaluation at each vertex of a terrain. Throws Error(usage), naming the
// field (points.0), for invalid points, or points together with a parabola.
class BendProfile {
 public:
  explicit BendProfile(const BendCurve& curve);
  // How far the ground at distance d ≥ 0 sinks, m.
  double drop_m(double distance_m) const;
  // Rise over run towards the viewer, the tangent of the inclination: -drop'.
  double slope(double distance_m) const;

 private:
  // A polynomial in d - from, from the control point at `from` to the next.
  struct Piece {
    double from = 0.0;
    double drop[5] = {};
  };
  const Piece& piece(double distance_m) const;
  void join_drops(const std::vector<BendPoint>& points);
  void join_inclinations(const std::vector<BendPoint>& points);
  double highest_drop() const;

  BendCurve curve_;
  std::vector<Piece> pieces_;  // the first and last are straight and unbounded; empty: parabola
};

// Tangents at the knots of a piecewise cubic that is monotone wherever the values are: weighted
// harmonic means of the slopes on both sides (Fritsch & Butland 1984), zero at extrema; at the ends
// the three-point formula, limited likewise. Two knots or more, x ascending.
std::vector<double> monotone_tangents(const std::vector<double>& x, const std::vector<double>& y);

// Coefficients of t², t³ of the cubic that starts at y0 with tangent m0 and reaches y1 with m1
// after `run`.
struct Cubic {
  double square, cube;
};
Cubic hermite(double run, double y0, double y1, double m0, double m1);

// The curve through points (x ascending) that does not overshoot; constant before the first and
// after the last. Without points it is 1 everywhere.
class MonotoneCurve {
 public:
  MonotoneCurve() = default;
  explicit MonotoneCurve(std::vector<glm::dvec2> points);
  double at(double x) const;

 private:
  struct Piece {
    double from, value, slope;
    Cubic cubic;
  };
  std::vector<Piece> pieces_;
  glm::dvec2 last_{0.0, 1.0};
};

}  // namespace belvedere
