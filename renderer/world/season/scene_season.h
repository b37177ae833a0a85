#pragma once

#include <optional>

#include "base/progress.h"
#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"
#include "terrain/climate/zonal_climate.h"
#include "terrain/io/dem.h"

namespace belvedere {

// The day of the year of a scene's date, 0…364; the 29th of February counts as the 28th.
std::optional<int> day_of_season(const SceneSeason& season);

// The palette for the place and time of a scene. "summer", "autumn" and "winter" have altitudes of
// the northern Alps: if rules take the treeline from the climate they move with it. On a date
// "summer" turns to "autumn" from the heights down: by how far the day's mean has fallen from the
// warmest day's (all of 6 K) and below 11.5 °C (all at 6.5 °C), whichever is less; not from
// midwinter to midsummer. Other palettes, and terrain of unknown position, are unchanged.
Palette palette_for_location(const Palette& palette, const LoadedScene& loaded, const Dem& dem);

// Altitude from which lakes freeze in winter: where the mean of the coldest month falls to -3 °C;
// infinite where it does nowhere, minus infinite where it does everywhere. palette_for_location
// puts it into winter palettes, by the climate at the centre of the terrain, unless the scene sets
// always or never; terrain of unknown position has no ice.
double lakes_freeze_from_m(const PlaceClimate& climate);

// Progress of autumn at such daily means: 0…1.
double autumn_share(const std::array<double, 365>& days_c, int day);

}  // namespace belvedere
