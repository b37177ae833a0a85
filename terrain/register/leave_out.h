#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/matrix/matrix.h"

namespace belvedere {

// What the others say about a group of observations that is left out.
struct LeftOut {
  std::vector<double> residuals;  // observed less predicted
  Matrix covariance;              // of them, noise included
};

// Leaves out each group in turn, in closed form. Observations y = f(θ) + ε, ε of that covariance,
// θ of that prior precision (inverse covariance); `residuals` are y - f(θ) at the θ most likely by
// all, `slopes` the derivatives of f there. With C⁻¹ the inverse of covariance + slopes
// precision⁻¹ slopesᵀ, a group g has residuals ([C⁻¹]_gg)⁻¹ [covariance⁻¹ residuals]_g and
// covariance ([C⁻¹]_gg)⁻¹: exactly what a fit without the group gives if f is linear. Groups hold
// different indices of observations. Throws Error(bug) for matrices that are not positive definite.
std::vector<LeftOut> leave_out(const Matrix& covariance, const Matrix& slopes,
                               const Matrix& precision, std::span<const double> residuals,
                               std::span<const std::vector<std::size_t>> groups);

}  // namespace belvedere
