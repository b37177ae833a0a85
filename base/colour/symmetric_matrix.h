#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace belvedere {

// Symmetric matrices of three rows: covariances of colours.

struct SymmetricEigen {
  glm::dvec3 values{0.0};   // in no order
  glm::dmat3 vectors{1.0};  // columns, of length 1
};
// By Jacobi rotations.
SymmetricEigen symmetric_eigen(glm::dmat3 a);

struct GainLimits {
  double min;
  double max;
};
// The linear map of colours of one covariance to colours of another that moves them least:
// A^-½ (A^½ B A^½)^½ A^-½, symmetric and positive (Pitié & Kokaram 2007), its eigenvalues held
// within the limits. `floor` is added to all variances, so that noise is not blown up.
glm::dmat3 linear_transport_map(const glm::dmat3& from, const glm::dmat3& to, double floor,
                                GainLimits gain);

}  // namespace belvedere
