#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "terrain/register/view_model.h"

namespace belvedere {

struct FitViewParameters {
  // Kinds to try; the one with the least cost is taken.
  std::vector<ViewKind> kinds = {ViewKind::plane, ViewKind::cylinder, ViewKind::panini};
  bool cropped = false;
};

// A view that shows the pairs where they are painted, all but those that are far off.
struct FittedView {
  ViewFrame frame;
  ViewUnknowns view = {};
  double cost = 0.0;       // of pairs, robust; comparable between kinds
  double median_px = 0.0;  // of the pairs' distances
};

// Finds the view from the pairs alone. Given the place of the eye all else in a cylinder's view is
// linear, so eyes are scanned on a lattice around the pairs, each with a robust line of azimuths on
// columns (Theil-Sen), the best with a robust fit of tangents on rows (least absolute deviations);
// from the best of those, all unknowns of each kind are fitted with Cauchy's loss. Ground that the
// painter moved counts as far off. The picture is 1200 px wide: all constants are for that. Best
// kind first; Error(input) if no eye explains the pairs.
std::vector<FittedView> fit_views(std::span<const ControlPair> pairs, glm::dvec2 size_px,
                                  const FitViewParameters& parameters = {},
                                  Progress& progress = silent_progress());

}  // namespace belvedere
