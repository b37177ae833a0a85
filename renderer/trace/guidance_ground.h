#pragma once

#include <cstddef>
#include <glm/vec2.hpp>

#include "base/guidance_buffers.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/terrain_model.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// Part of trace_guidance: ground values at a position (fractional column and row of the posts).

// Slope towards east (x) and north (y), rise over run: central differences at the posts (one-sided
// at the rim), interpolated bilinearly, so it is continuous and shows no facets.
glm::dvec2 sample_gradient(const Grid<float>& altitude_m, const GeoTransform& transform,
                           double column, double row);

// Where the ground seen at a position was before valleys were widened, in columns and rows: its
// content is read there.
glm::dvec2 origin_of(const TerrainModel& terrain, double column, double row);

// Writes everything about a pixel that depends only on the position into pixel i of the buffers:
// the position, its normals, slopes, relief and other values of the terrain model. The altitude is
// that of the ground drawn here, wherever it came from. `bumps_m`: width of the ground in the
// pixel, m; longer bumps of surface layers are part of its normals; 0: none are.
void sample_ground(const TerrainModel& terrain, const DeformedSurface& surface,
                   const Camera& camera, double column, double row, GuidanceBuffers& out,
                   std::size_t i, double bumps_m = 0.0);

// The class at a position of the surface; rock where none is known. Forest, grass and scree have
// ragged borders.
LandCoverClass class_at(const TerrainModel& terrain, double column, double row);

}  // namespace belvedere
