#pragma once

#include <vector>

#include "renderer/features/drawn_parts.h"
#include "renderer/features/feature_set.h"
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
// its longer side. A point becomes one of usual size whose ridge points down the slope. Appends it where it is seen, and counts it.
void draw_house(const HouseMaking& making, const Feature& feature, std::vector<DrawnHouse>& houses, DrawnCount& count);

// The rectangle around an outline that has the least area: its middle, half of its longer side and half of its shorter one as vectors.
struct Footprint {
  glm::dvec2 middle{0.0};
  glm::dvec2 along{0.0};
  glm::dvec2 across{0.0};
};
Footprint footprint_of(const std::vector<glm::dvec2>& outline);

}  // namespace belvedere
