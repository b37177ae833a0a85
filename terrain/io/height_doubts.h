#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Checks for implausible elevation. Every command that reads elevation calls both functions, so
// that all give the same errors and notes.

// Plausible altitudes, m: from the Challenger Deep (-10935) to Everest (8849), with a margin.
constexpr float lowest_ground_m = -11000.F;
constexpr float highest_ground_m = 9000.F;

// Before the cells are read. Throws Error(input) for a band of colours instead of heights: a shaded
// relief, a rendered map, a palette. Notes on files of 8 bits, on heights without a unit
// under a coordinate system in feet, and on files whose centre lies far outside the area of use of
// their coordinate system (doubt_of_place). Returns the sources as their cells are to be read:
// - 0 is void where it marks cells outside an outline: the median step to the ground beside it is
//   larger than at a coast. Noted.
// - Spikes of single cells are void: RasterSource::max_spike_m.
std::vector<RasterSource> check_height_sources(const std::vector<RasterSource>& sources,
                                               Progress& progress);

// After reading: notes on the cells that were taken as void though no header says so.
void note_dropped_cells(const RasterFile& file, Progress& progress);

// After reading: notes on heights below the lowest or above the highest ground, with the keys that
// help.
void note_height_range(const std::string& where, float lowest_m, float highest_m,
                       Progress& progress);

}  // namespace belvedere
