#pragma once

#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "terrain/climate/climate.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Whether a scene sets anything of its climate.
bool names_climate(const Scene& scene);

// Whether the position of a scene's terrain on the Earth is known: by its coordinate system, or by
// climate.latitude_deg.
bool knows_place(const Scene& scene, const Dem& dem);
// Error(usage) naming climate.latitude_deg where it is not.
void require_place(const Scene& scene, const Dem& dem);

// The climate of a scene's terrain, from [climate] and built-in values for the place. Its source
// and certainty go to `progress` as notes. Throws what make_climate throws.
Climate make_scene_climate(const LoadedScene& loaded, const Dem& dem, Progress& progress);

}  // namespace belvedere
