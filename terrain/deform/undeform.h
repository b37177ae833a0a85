#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "terrain/deform/deform.h"

namespace belvedere {

// Inverse of the deformation: the point (x, y, altitude) that it moves to `deformed`, if there is
// one; within a millimetre where handles and summits raise the ground, else exact up to rounding.
// Used to find the real air along a line of sight.
std::optional<glm::dvec3> undeform(const Deformation& deformation, glm::dvec3 deformed);

}  // namespace belvedere
