#pragma once

#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "terrain/cover/map_cover.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/shape/catchments.h"
#include "terrain/shape/courses.h"

namespace belvedere {

// Rivers of a map, before they lie in the valleys of a DEM.
struct MapRivers {
  std::vector<DrawnCourse> lines;  // their group: the row of `looks`
  std::vector<CoverCourse> looks;  // class and rank of groups of rivers; without places
  std::vector<double> least_px;    // of groups: how wide a river is on the picture at least, where three times its width does it
};

// What rivers are looked at with.
struct SeenFrom {
  const Camera& camera;
  const Deformation& deformation;
};

// The courses they take in the valleys of this DEM; the cache keeps them. Says how far they moved. `catchments`: of the DEM, where somebody
// has them; `seen`: rivers that would break into dots are drawn wider, up to three times.
std::vector<CoverCourse> lay_rivers(const MapRivers& rivers, const LoadedScene& loaded, const Dem& dem, Progress& progress,
                                    const Cache& cache = no_cache(), Catchments* catchments = nullptr, const SeenFrom* seen = nullptr);

}  // namespace belvedere
