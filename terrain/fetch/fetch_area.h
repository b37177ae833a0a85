#pragma once

#include <string>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "terrain/fetch/fetch_record.h"
#include "terrain/fetch/fetched_area.h"

namespace belvedere {

// The frame that a request makes at a width of cells: middle and size rounded outwards to whole cells of the zone's lattice. Error(usage)
// for values out of range, and where a pole lies inside.
RasterFrame fetch_frame(const FetchParameters& parameters, double cell_m);
// Degrees that hold a frame.
DegreeBox degrees_around(const RasterFrame& frame, const std::string& crs);

// Fetches the maps of an area and writes them into a folder, which is made where it is missing: elevation.tif (m, voids -9999),
// land_cover.tif (codes, 0 where nothing is known) and fetched.toml, which says where they come from. Files appear whole or not at all, the
// record last, with `head` before it. What comes is kept in the cache, so that a call after one that failed goes on where that ended.
// Servers are asked, because whoever calls this wants it. Error(input) where they fail, Error(output) where the folder cannot be written.
FetchedArea fetch_area(const FetchParameters& parameters, const std::string& folder, const Cache& cache, Progress& progress,
                       const RecordHead& head = {});

}  // namespace belvedere
