#pragma once

#include <glm/vec2.hpp>

#include "renderer/trace/camera.h"
#include "renderer/trace/hit.h"
#include "renderer/trace/traced_part.h"

namespace belvedere {

// The exact hit, in double, from the facet that float tracing reported: `in_tile` is its position
// in the tile, 0…1. The ray's origin is relative to the surface's. Fills all of `hit` but its
// window. False where in double the ray misses the facet (it grazed an edge).
bool resolve_facet(const TracedPart& part, const GridTile& tile, glm::vec2 in_tile, const Ray& ray,
                   Hit& hit);

// A position on a surface, column and row within its posts: on one of the two triangles of its
// cell, whose common side runs from north-east to south-west.
glm::dvec3 on_facet(const Grid<glm::vec3>& posts, glm::dvec2 at);

}  // namespace belvedere
