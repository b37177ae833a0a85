#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/features/feature_style.h"
#include "renderer/features/ground_sight.h"

namespace belvedere {

// A place of a line on the drawn ground.
struct LineSample {
  glm::dvec2 map{0.0};    // in the terrain's CRS
  glm::dvec3 point{0.0};  // in the deformed world
  glm::dvec2 pixel{0.0};
  double distance_m = 0.0;
  double hidden_by_m = 0.0;  // how far before it ground stands; 0: none does
  bool on_terrain = false;
  bool projected = false;   // on the terrain and before the eye
  bool in_picture = false;  // or little beside it
  bool seen = false;
};

// Samples of a line, nowhere farther apart than half a cell of the ground or a pixel of the picture, whichever is longer, and closer where
// the ground bends between them by a third of a pixel. Where it vanishes behind ground, or comes out, samples lie within half a pixel of
// that place.
std::vector<LineSample> sample_line(const GroundSight& sight, const std::vector<glm::dvec2>& line, double px_per_mm);

// Whether each sample is seen.
void find_seen(const GroundSight& sight, std::vector<LineSample>& samples, double px_per_mm);

// How large a kind's lengths are at a place of the picture.
struct PointLook {
  double share = 1.0;    // of those of the foreground
  double half_px = 0.5;  // half of the fill's width
  bool too_far = false;  // the sheet is too coarse there for the kind
};
PointLook look_at(const GroundSight& sight, glm::dvec3 point, glm::dvec2 pixel, const FeatureKind& kind, double width_mm, double real_m,
                  double px_per_mm, double foreground_m_per_px);

}  // namespace belvedere
