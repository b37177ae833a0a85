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
};

// What rivers are looked at with.
struct SeenFrom {
  const Camera& camera;
  const Deformation& deformation;
};

// The courses they take in the valleys of this DEM, with their own widths; the cache keeps them. Says how far they moved. `catchments`: of
// the DEM, where somebody has them.
std::vector<CoverCourse> lay_rivers(const MapRivers& rivers, const LoadedScene& loaded, const Dem& dem, Progress& progress,
                                    const Cache& cache = no_cache(), Catchments* catchments = nullptr);

// The same as a picture draws them: those that would be narrower than least_px are wider, up to three times. Guessed rivers that are too
// narrow even so fade, as dots are worse than nothing; those of maps stay.
struct RiverLook {
  double least_px = 0.0;  // across their way in the picture
  bool fades = false;
};
CoverCourse widen_for_view(CoverCourse river, const RiverLook& look, const Dem& dem, const SeenFrom& seen);

}  // namespace belvedere
