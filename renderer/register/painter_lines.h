#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/land_cover_class.h"
#include "base/parallel.h"

namespace belvedere {

// The lines of a painter's land cover, as parameters of class rules.
struct PainterLines {
  double treeline_m = 0.0;  // where forest ends; 0: the paint does not tell
  double snowline_m = 0.0;  // where snow begins; 0: the paint does not tell
  bool winter = false;      // snow on everything but forest and steep rock
  double ice_line_m = 0.0;  // above which glaciers form; 0: the paint does not tell
};

// Features of a pixel of the ground that are compared.
struct PaintSample {
  glm::dvec3 oklab{0.0};
  glm::dvec3 normal{0.0};
  double distance_m = 0.0;
};

// The classes of the samples by rules with some lines.
using ClassesOfLines = FunctionRef<std::vector<LandCoverClass>(const PainterLines& lines)>;

// The lines from min_m to max_m that explain the colours of a painting best. Given the
// classes, the colour of a sample is linear in its normal (so that any light will do), its distance
// and ln distance, besides a constant of its class: the lines leave the least determinant of the
// covariance of what remains. A treeline counts only with forest darker than meadows, a snow line
// or an ice line only with snow and ice clearly paler than all other open ground and not yellower
// than stone. A line that gains less than half a percent is left to the rules. `winter` if meadows
// are as pale and as colourless as snow, and snow on them explains the colours as well.
PainterLines find_painter_lines(std::span<const PaintSample> samples, double min_m, double max_m,
                                ClassesOfLines classes_of);

}  // namespace belvedere
