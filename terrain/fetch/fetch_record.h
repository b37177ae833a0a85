#pragma once

#include <string>

#include "terrain/fetch/fetched_area.h"

namespace belvedere {

// The tables of a scene that name the maps of an area, with origin, licence and legend: [[terrain.sources]], [land_cover] and
// [[land_cover.sources]]. folder: goes before the files' names; empty: none.
std::string scene_sources(const FetchedArea& area, const std::string& folder);
// TOML that says of every map and tile where it comes from, with the tables for a scene first.
std::string fetch_record(const FetchParameters& parameters, const FetchedArea& area);
// Writes it: whole or not at all. Error(output).
void write_fetch_record(const std::string& path, const FetchParameters& parameters, const FetchedArea& area);

}  // namespace belvedere
