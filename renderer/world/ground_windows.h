#pragma once

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/ground/laid_rivers.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/world/ground_plan.h"
#include "renderer/world/view.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem_levels.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// Input of windows.
struct WindowMaking {
  const LoadedScene& loaded;
  const View& view;
  const Deformation& deformation;
  const Sea& sea;  // of the whole
  DemLevels& levels;
  Progress& progress;
  const Cache& cache;
  const SeenFrom& seen;
};

// Reads, covers and generalizes each window of the plan with a halo, like the whole, and blends it
// into the coarser ground: along the edge of its part the coarser values apply, 32 cells inwards
// its own. Entering rivers keep the whole's values; settlements, climate and the sea are those of
// the whole. `terrain` is the whole's.
void add_ground_windows(TerrainModel& terrain, const GroundPlan& plan, const WindowMaking& making);

// The terrain's generalized ground and that of its windows, deformed and joined.
DeformedSurface deform_ground(const TerrainModel& terrain, glm::dvec3 origin,
                              const Deformation& deformation);

}  // namespace belvedere
