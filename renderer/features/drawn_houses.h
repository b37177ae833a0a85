#pragma once

#include <vector>

#include "renderer/features/feature_style.h"
#include "renderer/features/footprint.h"
#include "renderer/features/line_samples.h"

namespace belvedere {

struct HouseMaking {
  const GroundSight& sight;
  const FeatureKind& kind;
  double px_per_mm;
  double foreground_m_per_px;
  glm::dvec3 sun;  // unit, towards the sun
};

// A house on its footprint, with its length, width and orientation, not smaller on the sheet than
// the style's minimum, with a saddle roof along its longer side or along that of each wing. A point
// becomes a house of standard size whose ridge points down the slope. Appends it if visible, and
// counts it.
void draw_house(const HouseMaking& making, const Feature& feature, std::vector<DrawnHouse>& houses,
                DrawnCount& count);

}  // namespace belvedere
