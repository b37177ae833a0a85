#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/cover/towns.h"

namespace belvedere {

// Radius of a circle as large as a town of that many people: √(population · 170 m² / π). 170 m² of built-up ground a head is the mean of
// the eight towns that scenes/karwendel.toml has by radius, from 100 (Mittenwald) to 220 (Hall in Tirol).
double town_radius_m(double population);

// Towns from a table of points (terrain/io/points.h) with columns name, and radius_m or population; a radius has the last word. `crs`: the
// scene's. Rows that say neither, or 0, are left out, and a note says how many. Throws Error(usage) where neither column is there, and
// for sizes that are no number or beyond largest_town_radius_m; else what read_points throws.
std::vector<KnownTown> read_towns(const std::string& path, const std::string& crs, Progress& progress);

}  // namespace belvedere
