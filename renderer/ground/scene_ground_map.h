#pragma once

#include <optional>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/ground/laid_rivers.h"
#include "renderer/scene/scene_file.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/map_cover.h"
#include "terrain/cover/towns.h"
#include "terrain/io/dem.h"
#include "terrain/shape/catchments.h"
#include "terrain/shape/known_lakes.h"

namespace belvedere {

// What a scene's [[features]] make of the ground: classes of areas, rivers, lakes, towns.
struct GroundMap {
  std::vector<CoverArea> areas;  // lakes among them
  MapRivers rivers;
  std::vector<KnownLake> lakes;  // level water
  std::vector<KnownTown> towns;  // that say how large they are
  bool keeps_rivers = true;      // guessed rivers stay
  bool keeps_towns = true;       // guessed villages stay

  bool empty() const { return areas.empty() && rivers.lines.empty() && towns.empty(); }
};

// Reads them, where any can be ground; the cache keeps what was read, by the content of the files. Notes what is left out and why.
GroundMap read_ground_map(const LoadedScene& loaded, const Dem& dem, Progress& progress, const Cache& cache = no_cache());

// Makes the map's lakes level in the DEM. `whole`: of a window, the DEM that it is part of, whose lakes are level already.
void level_scene_lakes(Dem& dem, const LoadedScene& loaded, Progress& progress, const Cache& cache = no_cache(),
                       const Dem* whole = nullptr);

// Lays the map over classes: areas as they are, rivers in the valleys of this DEM, and below all of them the rivers that rules guessed. The
// cache keeps where rivers run. With a camera no river is drawn so narrow that it breaks into dots, as long as it need not be more than
// three times as wide for that; the cells of the cover know no camera.
void lay_ground_map(LandCover& cover, const LoadedScene& loaded, const Dem& dem, Progress& progress, const Cache& cache = no_cache(),
                    Catchments* catchments = nullptr, const SeenFrom* seen = nullptr);

// The last of that alone: rivers that rules guessed, as those of the scene's style.
void lay_guessed_rivers(LandCover& cover, const LoadedScene& loaded, const Dem& dem, const SeenFrom* seen = nullptr);

}  // namespace belvedere
