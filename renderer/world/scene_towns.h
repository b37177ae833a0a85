#pragma once

#include <vector>

#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "terrain/cover/towns.h"
#include "terrain/io/dem.h"

namespace belvedere {

// The known towns of a scene, from [[land_cover.towns]] and then from its towns_file, in the DEM's
// CRS. A note names those outside the terrain. They are kept, because a town may extend over the
// border and keeps others away, but for those too far off to matter: 20 km and five radii. Throws
// Error(usage) for positions without CRS, else what read_towns throws.
std::vector<KnownTown> make_scene_towns(const LoadedScene& loaded, const Dem& dem,
                                        Progress& progress);

}  // namespace belvedere
