#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "terrain/io/raster.h"

namespace belvedere {

// A moved ground as a grid again: what another program reads. `move` takes x, y, altitude to the place where they go (see Deformation);
// the result has the same cells, each the height of the moved facets at its centre, of the highest where the ground covers itself
// (an overhang has one height only), NaN where none came to lie. Where nothing moves in plan the cells keep their own posts, exactly.
// Same bits for any thread count.
Grid<float> raster_of_moved(const Grid<float>& altitude_m, const GeoTransform& transform,
                            const std::function<glm::dvec3(glm::dvec3)>& move);

}  // namespace belvedere
