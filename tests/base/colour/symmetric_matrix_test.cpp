#include "base/colour/symmetric_matrix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace belvedere {
namespace {

glm::dmat3 symmetric(double xx, double xy, double xz, double yy, double yz, double zz) {
  return {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
}

TEST(SymmetricEigen, VectorsAreTurnedIntoTheirMultiples) {
  const glm::dmat3 a = symmetric(4.0, 1.0, -0.5, 3.0, 0.7, 2.0);
  const SymmetricEigen eigen = symmetric_eigen(a);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(glm::length(eigen.vectors[k]), 1.0, 1e-12);
    EXPECT_LT(glm::length(a * eigen.vectors[k] - eigen.values[k] * eigen.vectors[k]), 1e-12);
  }
}

TEST(SymmetricEigen, KnownValues) {
  // [2 1; 1 2] has 1 and 3.
  const SymmetricEigen eigen = symmetric_eigen(symmetric(2.0, 1.0, 0.0, 2.0, 0.0, 5.0));
  std::array<double, 3> values = {eigen.values.x, eigen.values.y, eigen.values.z};
  std::sort(values.begin(), values.end());
  EXPECT_NEAR(values[0], 1.0, 1e-12);
  EXPECT_NEAR(values[1], 3.0, 1e-12);
  EXPECT_NEAR(values[2], 5.0, 1e-12);
}

TEST(LeastMovingMap, TakesOneCovarianceToTheOther) {
  const glm::dmat3 from = symmetric(0.04, 0.01, 0.0, 0.02, 0.003, 0.01);
  const glm::dmat3 to = symmetric(0.02, -0.004, 0.001, 0.03, 0.0, 0.02);
  const glm::dmat3 map = linear_transport_map(from, to, 0.0, {0.01, 100.0});
  const glm::dmat3 got = map * from * glm::transpose(map);
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) {
      EXPECT_NEAR(got[c][r], to[c][r], 1e-12);
      EXPECT_NEAR(map[c][r], map[r][c], 1e-12);
    }
}

TEST(LeastMovingMap, KeepsItsGainsWithinTheLimits) {
  const glm::dmat3 map = linear_transport_map(symmetric(1, 0, 0, 1, 0, 1),
                                              symmetric(100, 0, 0, 1, 0, 0.01), 0.0, {0.5, 2.0});
  EXPECT_NEAR(map[0][0], 2.0, 1e-9);
  EXPECT_NEAR(map[1][1], 1.0, 1e-9);
  EXPECT_NEAR(map[2][2], 0.5, 1e-9);
}

}  // namespace
}  // namespace belvedere
