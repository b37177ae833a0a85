#pragma once

#include <string>

#include "terrain/fetch/fetch_area.h"

namespace belvedere {

// The tables of a scene that name the maps of a fetched area, with origin, licence and legend:
// [[terrain.sources]], [land_cover] and [[land_cover.sources]]. folder: prefix of the files' names;
// may be empty.
std::string fetched_sources(const FetchedArea& area, const std::string& folder);

}  // namespace belvedere
