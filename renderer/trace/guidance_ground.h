#pragma once

#include <cstddef>
#include <glm/vec2.hpp>

#include "base/guidance_buffers.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/terrain_model.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// Part of trace_guidance: what the ground says at a place (fractional column and row of the posts).

// Slope towards east (x) and north (y), rise over run: central differences at the posts (one-sided at the rim), interpolated
// bilinearly, so it is continuous and shows no facets.
glm::dvec2 sample_gradient(const Grid<float>& altitude_m, const GeoTransform& transform, double column, double row);

// The place in columns and rows where the ground seen here was before valleys were widened: what lies on it lies there.
glm::dvec2 origin_of(const TerrainModel& terrain, double column, double row);

// Everything of a pixel that depends on the place alone, put into pixel i of the buffers: where it lies, its normals, slopes, relief and
// what else the terrain model holds. The altitude is that of the ground that lies here, wherever it came from. `bumps_m`: how wide the
// ground is that the pixel shows, m: the bumps of surface layers that are longer belong to its normals; 0: none do.
void sample_ground(const TerrainModel& terrain, const DeformedSurface& surface, const Camera& camera, double column, double row,
                   GuidanceBuffers& out, std::size_t i, double bumps_m = 0.0);

// The class that lies at a place of the surface; rock where none is known. Woods, grass and scree end in ragged borders.
LandCoverClass class_at(const TerrainModel& terrain, double column, double row);

}  // namespace belvedere
