#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "base/grid.h"
#include "renderer/register/registered_guidance.h"
#include "terrain/register/registration.h"

namespace belvedere::bench {

// How well the classes of a painting agree with the true ones: mean intersection over union of
// those on more than half a percent of the ground, and the share of ground with the right one.
struct ClassAgreement {
  double iou = 0.0;
  double right = 0.0;
};

struct CoverTrial {
  PainterLines lines;             // found
  ClassAgreement rules, painted;  // with the lines of the climate: rules alone, and the paint
  ClassAgreement own_rules, own;  // with the painter's own lines
};

// Of a registered painting of that terrain; truth: guidance.exr of the picture that was painted.
CoverTrial try_cover(const Registration& registration, const Grid<glm::vec3>& painting,
                     const std::shared_ptr<const Dem>& dem, const std::string& truth);

}  // namespace belvedere::bench
