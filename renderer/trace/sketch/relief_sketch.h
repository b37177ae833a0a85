#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"
#include "terrain/io/raster.h"

namespace belvedere {

// A quick picture of a deformed terrain to evaluate its shape: grey relief shading, paler with
// distance, marked ground in green-yellow, a plain sky. Encoded sRGB 0…1, of the camera's size.
// altitude_m and marked have a cell for each post of the surface; marked may be empty.
Grid<glm::vec3> make_relief_sketch(const Grid<float>& altitude_m, const GeoTransform& transform,
                                   const Grid<std::uint8_t>& marked, const Deformation& deformation,
                                   const Tracer& tracer, const Camera& camera,
                                   glm::dvec3 sun_direction);

}  // namespace belvedere
