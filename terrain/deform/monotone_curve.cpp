#include "terrain/deform/monotone_curve.h"

#include <algorithm>
#include <cmath>

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

}  // namespace belvedere
