#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/io/raster_source.h"

namespace belvedere {

// Elevation that is hard to believe. Every command that reads elevation calls both functions, so
// that all of them refuse and note the same.

// The ground of this planet, m: the Challenger Deep at -10935, Everest at 8849, and some slack.
constexpr float lowest_ground_m = -11000.F;
constexpr float highest_ground_m = 9000.F;

// Before the cells are read. Throws Error(input) for a band that holds colours, not heights: of a
// shaded relief, a rendered map, a palette. Notes on files of 8 bits, on heights without a unit
// under a coordinate system in feet, and on files whose centre lies far outside the area of use of
// their coordinate system (doubt_of_place).
void check_height_sources(const std::vector<RasterSource>& sources, Progress& progress);

// After reading: notes on heights beyond the lowest and highest ground, and on values that were
// taken as void although no header says so, with the keys that help.
void note_height_range(const std::string& where, float lowest_m, float highest_m,
                       Progress& progress);

}  // namespace belvedere
