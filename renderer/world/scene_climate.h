#pragma once

#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "terrain/climate/climate.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Whether a scene says anything of its climate.
bool names_climate(const Scene& scene);

// The climate of a scene's terrain, from [climate] and what is known of the place. What it was made from and how sure that is goes to
// `progress` as notes. Throws what make_climate throws.
Climate make_scene_climate(const LoadedScene& loaded, const Dem& dem, const DefaultClimate& fallback, Progress& progress);
// With the plain default below.
Climate make_scene_climate(const LoadedScene& loaded, const Dem& dem, Progress& progress);

// A climate by latitude alone: sea level's mean of the year 27 - .0082 φ² °C and half a range of .14 φ K between its warmest and coldest
// month, 5.6 K/km, 1000 mm. Right to some kelvins, so that there is never none.
ClimateColumn plain_climate(glm::dvec2 lonlat_deg);

}  // namespace belvedere
