#pragma once

#include <memory>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/features/feature_style.h"
#include "renderer/ground/laid_rivers.h"
#include "renderer/scene/scene_file.h"
#include "terrain/cover/ground_lakes.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/map_cover.h"
#include "terrain/cover/towns.h"
#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {

// The ground that a scene's [[features]] define: classes of areas, rivers, lakes, towns.
struct GroundMap {
  std::vector<CoverArea> areas;  // including lakes
  MapRivers rivers;
  std::vector<KnownLake> lakes;  // level water
  std::vector<KnownTown> towns;  // with a known size
  bool keeps_rivers = true;      // inferred rivers stay
  bool keeps_towns = true;       // inferred villages stay

  bool empty() const { return areas.empty() && rivers.lines.empty() && towns.empty(); }
};

// Reads them if any can be ground; cached by the content of the files. Notes what is left out and
// why.
GroundMap read_ground_map(const LoadedScene& loaded, const Dem& dem, Progress& progress,
                          const Cache& cache = no_cache());

// Levels the map's lakes in the DEM. `whole`: for a window, the DEM that it is part of, whose lakes
// are already level.
void level_scene_lakes(Dem& dem, const LoadedScene& loaded, Progress& progress,
                       const Cache& cache = no_cache(), const Dem* whole = nullptr);

// Lays the map over classes: areas as they are, rivers in the valleys of this DEM, and below all of
// them the rivers inferred by rules. River centrelines are cached. With a camera, rivers that would
// break into dots are widened, up to three times; the cells of the cover do not depend on the
// camera.
void lay_ground_map(LandCover& cover, const LoadedScene& loaded, const Dem& dem, Progress& progress,
                    const Cache& cache = no_cache(), Catchments* catchments = nullptr,
                    const SeenFrom* seen = nullptr);

// The areas alone, lakes among them; null where the map has none.
std::shared_ptr<const MapCover> areas_of_map(const LoadedScene& loaded, const Dem& dem,
                                             const Cache& cache = no_cache());

// Only the last of these: rivers inferred by rules, in the scene's style.
void lay_inferred_rivers(LandCover& cover, const LoadedScene& loaded, const Dem& dem,
                         const SeenFrom* seen = nullptr);

// The outer edges of a terrain.
MapBox box_of(const Dem& dem);

// The style named in a scene.
FeatureStyle read_scene_feature_style(const LoadedScene& loaded);

// The scene's blocks of features as sources, in their order. A missing file is skipped here;
// callers that need it report it.
std::vector<FeatureSource> feature_sources(const LoadedScene& loaded);

// Features of a scene's files that become ground, only from blocks that can contain such. Features
// outside the terrain are only counted and noted. Throws Error(usage) with both extents if all of a
// file lies outside the terrain: its coordinate system is then probably wrong.
FeatureSet read_ground_features(const LoadedScene& loaded, const FeatureStyle& style,
                                const Dem& dem, Progress& progress);

}  // namespace belvedere
