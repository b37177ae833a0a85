#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "terrain/io/raster.h"

namespace belvedere {

// Resamples a deformed ground to a grid, for other programs. `move` maps x, y, altitude to the new
// position (see Deformation). The result has the same cells, each the height of the deformed facets
// at its centre, of the highest one where the ground overlaps itself (a grid cannot represent
// overhangs), NaN where there is none. Where nothing moves in plan the cells keep their own posts
// exactly. Same bits for any thread count.
Grid<float> raster_of_moved(const Grid<float>& altitude_m, const GeoTransform& transform,
                            const std::function<glm::dvec3(glm::dvec3)>& move);

}  // namespace belvedere
