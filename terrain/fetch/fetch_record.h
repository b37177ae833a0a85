#pragma once

#include <functional>
#include <string>

#include "terrain/fetch/fetched_area.h"

namespace belvedere {

// Text at the start of a record, for direct use by its reader.
using RecordHead = std::function<std::string(const FetchedArea&)>;
// TOML with the provenance of every map and tile, after the head.
std::string fetch_record(const FetchParameters& parameters, const FetchedArea& area,
                         const RecordHead& head = {});
// Writes it atomically. Error(output).
void write_fetch_record(const std::string& path, const FetchParameters& parameters,
                        const FetchedArea& area, const RecordHead& head = {});

}  // namespace belvedere
