#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/features/feature_style.h"
#include "renderer/features/ground_sight.h"

namespace belvedere {

// A point of a line on the drawn ground.
struct LineSample {
  glm::dvec2 map{0.0};    // in the terrain's CRS
  glm::dvec3 point{0.0};  // in the deformed world
  glm::dvec2 pixel{0.0};
  double distance_m = 0.0;
  double hidden_by_m = 0.0;  // distance to the ground in front of it; 0: none
  bool on_terrain = false;
  bool projected = false;   // on the terrain and in front of the eye
  bool in_picture = false;  // or slightly outside
  bool seen = false;
};

// Samples of a line, at most half a cell of the ground or a pixel of the picture apart, whichever
// is longer, and closer where the ground bends between them by a third of a pixel. Where it
// disappears behind ground, or reappears, samples lie within half a pixel of that position.
std::vector<LineSample> sample_line(const GroundSight& sight, const std::vector<glm::dvec2>& line,
                                    double px_per_mm);

// Whether each sample is visible.
void find_seen(const GroundSight& sight, std::vector<LineSample>& samples, double px_per_mm);

// The scale of a kind's lengths at a position of the picture.
struct PointLook {
  double share = 1.0;    // relative to the foreground
  double half_px = 0.5;  // half of the fill's width
  bool too_far = false;  // the scale there is too small for the kind
};
PointLook look_at(const GroundSight& sight, glm::dvec3 point, glm::dvec2 pixel,
                  const FeatureKind& kind, double width_mm, double real_m, double px_per_mm,
                  double foreground_m_per_px);

}  // namespace belvedere
