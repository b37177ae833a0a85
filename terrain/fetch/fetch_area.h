#pragma once

#include <string>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "terrain/fetch/fetched_area.h"

namespace belvedere {

// The frame of a request at a cell size: centre and size rounded outwards to whole cells of the
// zone's lattice. Error(usage) for values out of range, and if a pole lies inside.
RasterFrame fetch_frame(const FetchParameters& parameters, double cell_m);
// Degrees that contain a frame.
DegreeBox degrees_around(const RasterFrame& frame, const std::string& crs);

// Downloads the maps of an area and writes them into a folder, which is created if it is missing:
// elevation.tif (m, voids -9999), land_cover.tif (codes, 0 where unknown) and fetched.toml with
// their provenance. Files are written atomically, the record last, with `head` at its start.
// Downloads are cached, so a call after a failed one continues. Accesses the network without
// asking. Error(input) if servers fail, Error(output) if the folder cannot be written.
FetchedArea fetch_area(const FetchParameters& parameters, const std::string& folder,
                       const Cache& cache, Progress& progress, const RecordHead& head = {});

}  // namespace belvedere
