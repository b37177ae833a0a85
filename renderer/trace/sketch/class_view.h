#pragma once

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/trace/tracer.h"

namespace belvedere {

// The class of each pixel of a picture, from one ray through its centre: to know what a picture
// contains before it is made. Equals GuidanceBuffers::land_cover of one sample per pixel bit for
// bit. Of `terrain` it reads dem, generalized_m, came_from, goes_to and land_cover; the others may
// be empty.
Grid<LandCoverClass> trace_classes(const TerrainModel& terrain, const Tracer& tracer,
                                   const Camera& camera);

}  // namespace belvedere
