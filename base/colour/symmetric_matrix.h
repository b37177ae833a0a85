#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace belvedere {

// Symmetric 3 × 3 matrices, such as covariances of colours.

struct SymmetricEigen {
  glm::dvec3 values{0.0};   // unsorted
  glm::dmat3 vectors{1.0};  // columns of length 1
};
// By Jacobi rotations.
SymmetricEigen symmetric_eigen(glm::dmat3 a);

struct GainLimits {
  double min;
  double max;
};
// Optimal linear transport (Monge–Kantorovich) of colours of covariance A to those of covariance B:
// A^-½ (A^½ B A^½)^½ A^-½, symmetric and positive (Pitié & Kokaram 2007), with eigenvalues clamped
// to the limits. `floor` is added to all variances, which limits the amplification of noise.
glm::dmat3 linear_transport_map(const glm::dmat3& from, const glm::dmat3& to, double floor,
                                GainLimits gain);

}  // namespace belvedere
