#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/view_layout.h"
#include "renderer/compose/view_shape.h"

namespace belvedere {

// A partly specified view.
struct GivenView {
  glm::dvec2 viewer{0.0};
  std::optional<double> azimuth_deg;  // without it the best of 24 directions
  double field_of_view_deg = 44.0;
  double aspect = 2.0;
  bool cylinder = false;
  LayoutGiven resolved;
};
// Completes it: the horizon as far away as the data allow, then the layout of proposals. Nothing
// where there are no data in that direction.
std::optional<ViewShape> complete_view(const CoarseGround& ground, const GivenView& given);

}  // namespace belvedere
