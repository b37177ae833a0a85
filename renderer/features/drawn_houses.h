#pragma once

#include <vector>

#include "renderer/features/drawn_parts.h"
#include "renderer/features/feature_set.h"
#include "renderer/features/footprint.h"
#include "renderer/features/ground_sight.h"

namespace belvedere {

struct HouseMaking {
  const GroundSight& sight;
  const FeatureKind& kind;
  double px_per_mm;
  double foreground_m_per_px;
  glm::dvec3 sun;  // unit, towards it
};

// A house on its footprint: as long, wide and turned as that is, never shorter on the sheet than the style says, with a saddle roof along
// its longer side, or along that of each of its wings. A point becomes one of usual size whose ridge points down the slope. Appends it
// where it is seen, and counts it.
void draw_house(const HouseMaking& making, const Feature& feature, std::vector<DrawnHouse>& houses, DrawnCount& count);

}  // namespace belvedere
