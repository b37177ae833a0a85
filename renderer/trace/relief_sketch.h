#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/terrain_model.h"
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

// The class of each pixel of a picture, from one ray through its centre: to know what a picture
// contains before it is made. Equals GuidanceBuffers::land_cover of one sample per pixel bit for
// bit. Of `terrain` it reads dem, generalized_m, came_from, goes_to and land_cover; the others may
// be empty.
Grid<LandCoverClass> trace_classes(const TerrainModel& terrain, const Tracer& tracer,
                                   const Camera& camera);

}  // namespace belvedere
