#pragma once

#include <functional>
#include <optional>

#include "base/progress.h"
#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"
#include "terrain/climate/climate.h"
#include "terrain/climate/zonal_climate.h"
#include "terrain/io/dem.h"

namespace belvedere {

// The day of the year of a scene's date, 0…364; the 29th of February counts as the 28th.
std::optional<int> day_of_season(const SceneSeason& season);

// Adapts a palette to the place and time of a scene. "summer", "autumn" and "winter" have altitudes
// of the northern Alps: if rules take the treeline from the climate they move with it. On a date
// "summer" turns to "autumn" from the heights down: by how far the day's mean has fallen from the
// warmest day's (all of 6 K) and below 11.5 °C (all at 6.5 °C), whichever is less; not from
// midwinter to midsummer. Other palettes, and terrain of unknown position, are unchanged.
Palette palette_for_location(const Palette& palette, const LoadedScene& loaded, const Dem& dem);

// Altitude from which lakes freeze in winter: where the mean of the coldest month falls to -3 °C;
// infinite where it does nowhere, minus infinite where it does everywhere. palette_for_location
// puts it into winter palettes, by the climate at the centre of the terrain, unless the scene sets
// always or never; terrain of unknown position has no ice.
double lakes_freeze_from_m(const PlaceClimate& climate);

// Progress of autumn on a day of a year with these daily means: 0…1.
double autumn_share(const std::array<double, 365>& days_c, int day);

// A palette with its ramps moved up by this height (down if < 0): its altitudes are those of the
// northern Alps, whose forest ends at palette_treeline_m.
Palette palette_at_other_altitudes(Palette palette, double higher_m);

// Blends two palettes by altitude: `share` is that of the second, 0…1, at an altitude in m. Ramps
// are blended every 50 m where it changes; colours without altitude (sky, air, leaves) take the
// mean of the shares at `lowest_m` and `highest_m`, the range of the picture. Winter is the
// first's.
Palette mix_palettes(const Palette& first, const Palette& second,
                     const std::function<double(double altitude_m)>& share, double lowest_m,
                     double highest_m);

// Whether a scene sets anything of its climate.
bool names_climate(const Scene& scene);

// Whether the position of a scene's terrain on the Earth is known: by its coordinate system, or by
// climate.latitude_deg.
bool knows_place(const Scene& scene, const Dem& dem);
// Error(usage) naming climate.latitude_deg where the position is not known.
void require_place(const Scene& scene, const Dem& dem);

// The climate of a scene's terrain, from [climate] and built-in values for the place. Its source
// and certainty go to `progress` as notes. Throws what make_climate throws.
Climate make_scene_climate(const LoadedScene& loaded, const Dem& dem, Progress& progress);

}  // namespace belvedere
