#pragma once

#include <optional>
#include <vector>

namespace belvedere {

// One place of a bend that is given by control points: how far the ground sinks there, or how it is tilted; one of the two.
struct BendPoint {
  double distance_m = 0.0;                // from the viewer, 0…1e8
  std::optional<double> drop_m;           // positive is down, -1e6…1e6
  std::optional<double> inclination_deg;  // of the level plain, -80…80: positive faces the viewer, 0 is level, negative turns away
};

// Progressive bending: the foreground turns towards the viewer like a map, the far ground sinks to the horizon. Either the parabola
//   drop = (d - crest)² / (2 radius) + [d > far_from] far_amount (d - far_from)²,
// d the horizontal distance from the viewer, which bends a level plain downwards by 1 / radius everywhere and by 2 far_amount more beyond
// far_from, where height and slope are continuous; or a curve through control points:
// - of drops: the monotone cubic of Fritsch & Butland (1984), C1, which never swings beyond its points;
// - of inclinations: the same through their tangents, integrated, so C2; the drop counts from the curve's highest place.
// Before the first and after the last point the ground keeps the inclination it has there.
struct BendCurve {
  double radius_m = 0.0;               // 0: no parabola; else 1000…1e9
  double crest_m = 0.0;                // distance where the ground is level
  double far_from_m = 0.0;             // ≥ 0
  double far_amount_per_m = 0.0;       // ≥ 0, 1/m
  std::vector<BendPoint> points = {};  // none, or two and more by distance, all with drops or all with inclinations
};

// A bend made ready: cheap to ask for each vertex of a terrain. Throws Error(usage), naming the field (points.0), for points that are no
// curve, or beside a parabola.
class BendProfile {
 public:
  explicit BendProfile(const BendCurve& curve);
  // How far the ground at distance d ≥ 0 sinks, m.
  double drop_m(double distance_m) const;
  // Its rise over run away from the viewer: the tangent of its inclination towards the viewer, -drop'.
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
  std::vector<Piece> pieces_;  // the first reaches back to the viewer, the last on for ever, both straight; empty: parabola
};

}  // namespace belvedere
