#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "terrain/deform/deform.h"

namespace belvedere {

// The point (x, y, altitude) that a deformation brings to `deformed`, where there is one: within a millimetre where the ground is raised
// by handles and summits, else exact up to rounding. Along a line of sight it says what the true air around the line is.
std::optional<glm::dvec3> undeform(const Deformation& deformation, glm::dvec3 deformed);

}  // namespace belvedere
