#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

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
