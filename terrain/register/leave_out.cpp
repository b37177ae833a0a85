#include "terrain/register/leave_out.h"

#include <optional>
#include <utility>

#include "base/error.h"

namespace belvedere {
namespace {

Cholesky factors_of(Matrix matrix, const char* what) {
  std::optional<Cholesky> factors = Cholesky::of(std::move(matrix));
  if (!factors) throw Error(ErrorKind::bug, what, "is not positive definite");
  return *std::move(factors);
}

Matrix sum(Matrix a, const Matrix& b, double factor) {
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t k = 0; k < a.columns(); ++k) a(i, k) += factor * b(i, k);
  return a;
}

}  // namespace

std::vector<LeftOut> leave_out(const Matrix& covariance, const Matrix& slopes,
                               const Matrix& precision, std::span<const double> residuals,
                               std::span<const std::vector<std::size_t>> groups) {
  const Cholesky factors = factors_of(covariance, "covariance");
  const std::vector<double> solved = factors.solve(residuals);
  // C⁻¹ by Woodbury's identity.
  const Matrix by_slopes = factors.solve(slopes);
  const Cholesky posterior =
      factors_of(sum(product(transposed(slopes), by_slopes), precision, 1.0), "precision");
  const Matrix inverse =
      sum(factors.inverse(), product(by_slopes, posterior.solve(transposed(by_slopes))), -1.0);
  std::vector<LeftOut> out;
  for (const std::vector<std::size_t>& group : groups) {
    Matrix block(group.size(), group.size());
    std::vector<double> of_group;
    for (std::size_t i = 0; i < group.size(); ++i) {
      of_group.push_back(solved[group[i]]);
      for (std::size_t k = 0; k < group.size(); ++k) block(i, k) = inverse(group[i], group[k]);
    }
    const Cholesky block_factors = factors_of(std::move(block), "observations");
    out.push_back({block_factors.solve(of_group), block_factors.inverse()});
  }
  return out;
}

}  // namespace belvedere
