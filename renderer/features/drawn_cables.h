#pragma once

#include <vector>

#include "renderer/features/feature_style.h"
#include "renderer/features/line_samples.h"

namespace belvedere {

struct CableMaking {
  const GroundSight& sight;
  const FeatureKind& kind;
  double px_per_mm;
  double foreground_m_per_px;
};

// A lift: its rope straight from station to station of the line, at the style's height above the
// ground, taut over hollows, on pylons at the style's spacing. Appends the visible parts and counts
// them.
void draw_cable(const CableMaking& making, const Feature& feature, std::vector<DrawnLine>& lines,
                DrawnCount& count);

}  // namespace belvedere
