#include "base/colour/symmetric_matrix.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace belvedere {
namespace {

// Applies f to the eigenvalues of a symmetric matrix.
template <class F>
glm::dmat3 spectral(const glm::dmat3& a, F f) {
  const SymmetricEigen eigen = symmetric_eigen(a);
  glm::dmat3 scale(0.0);
  for (int k = 0; k < 3; ++k) scale[k][k] = f(eigen.values[k]);
  return eigen.vectors * scale * glm::transpose(eigen.vectors);
}

glm::dmat3 root(const glm::dmat3& a) {
  return spectral(a, [](double v) { return std::sqrt(std::max(v, 0.0)); });
}

}  // namespace

SymmetricEigen symmetric_eigen(glm::dmat3 a) {
  SymmetricEigen out;
  for (int sweep = 0; sweep < 12; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (std::abs(a[q][p]) < 1e-18) continue;
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[q][p]);
        const double t =
            (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0);
        glm::dmat3 turn(1.0);
        turn[p][p] = turn[q][q] = c;
        turn[q][p] = c * t;
        turn[p][q] = -c * t;
        a = glm::transpose(turn) * a * turn;
        out.vectors = out.vectors * turn;
      }
  out.values = {a[0][0], a[1][1], a[2][2]};
  return out;
}

glm::dmat3 linear_transport_map(const glm::dmat3& from, const glm::dmat3& to, double floor,
                                GainLimits gain) {
  const glm::dmat3 least(floor);
  const glm::dmat3 half = root(from + least);
  const glm::dmat3 inverse = glm::inverse(half);
  const glm::dmat3 map = inverse * root(half * (to + least) * half) * inverse;
  return spectral(map, [&](double v) { return std::clamp(v, gain.min, gain.max); });
}

}  // namespace belvedere
