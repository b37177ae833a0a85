#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/cover/towns.h"
#include "terrain/io/vector_source.h"

namespace belvedere {

// Radius of a circle with the area of a town of that population: √(population · 170 m² / π). 170 m²
// of built-up ground per person is the mean of the eight towns that scenes/karwendel.toml has by
// radius, from 100 (Mittenwald) to 220 (Hall in Tirol).
double town_radius_m(double population);

// Towns from a table of points (terrain/io/points.h) with columns name, and radius_m or population;
// radius_m takes precedence. `crs`: the scene's. Rows with neither, or 0, are left out, with a note
// of their number. Throws Error(usage) if both columns are missing, and for sizes that are not
// numbers or beyond largest_town_radius_m; else as read_points does.
std::vector<KnownTown> read_towns(const VectorSource& source, const std::string& crs,
                                  Progress& progress);

}  // namespace belvedere
