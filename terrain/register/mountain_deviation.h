#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "base/matrix/matrix.h"
#include "terrain/deform/handles.h"
#include "terrain/register/registration.h"
#include "terrain/register/view_model.h"

namespace belvedere {

// How far the moves of mountains leave the pixels of their ground open: what the covariance of
// their unknowns says, the more where the places on the mountain agree less with its move.
// Immutable and thread-safe.
class MountainDeviation {
 public:
  explicit MountainDeviation(const Registration& registration);
  // Variance of the painting's pixel that shows a place, px², the mean of both directions; 0 on
  // ground that no mountain moves.
  double variance_px2(glm::dvec2 position, double altitude_m) const;

 private:
  struct Mountain {
    DeformHandle handle;
    double factor = 1.0;                     // on its variance
    std::vector<HandleField> ahead, behind;  // a step of each of its unknowns to both sides
    Matrix covariance;                       // of its unknowns
  };
  const ViewFrame frame_;
  const ViewUnknowns view_;
  const double scale_;
  std::vector<Mountain> mountains_;
};

}  // namespace belvedere
