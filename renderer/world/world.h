#pragma once

#include <memory>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/mist/mist_sight.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/guidance.h"
#include "renderer/trace/tracer.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/view.h"
#include "terrain/cover/land_cover.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/shape/catchments.h"

namespace belvedere {

// What a scene is made into before its first pixel, each value from those above it. Owned in one place because pixels of any part of the
// picture need all of it; nothing changes after it is made (make_world).
struct World {
  const Scene scene;
  const std::shared_ptr<const Dem> dem;  // of a DEM that is larger than memory the whole in coarse cells: terrain has finer windows
  const View view;                       // camera and sun on this DEM
  const std::unique_ptr<const Camera> camera;
  const std::shared_ptr<const LightField> light_field;  // null: one light everywhere
  const std::shared_ptr<const LandCover> land_cover;
  const Deformation deformation;
  const TerrainModel terrain;  // generalized for this view, and all that a pixel may ask of the ground
  // What is traced: generalized, exaggerated, bent; its origin is the eye's place at altitude 0.
  const std::unique_ptr<const DeformedSurface> surface;
  const Tracer tracer;
  const double horizon_px;  // row of the skyline's median
  const MistAir mist;
};

// Terrain that exists already, for several views of one synthetic terrain; what is null is made.
struct KnownTerrain {
  std::shared_ptr<const Dem> dem = nullptr;
  std::shared_ptr<const LandCover> land_cover = nullptr;
  std::unique_ptr<Catchments> catchments = nullptr;  // where water runs on the DEM
};

// Reads, generalizes and bends the terrain, sets up camera and sun, builds the acceleration structure. Throws Error for whatever is wrong
// with scene or data as soon as it can be known: the machine's instruction set first, the camera's place before land cover is made.
World make_world(const LoadedScene& loaded, Progress& progress, const Cache& cache = no_cache(), KnownTerrain known = {});

}  // namespace belvedere
