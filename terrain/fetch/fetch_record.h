#pragma once

#include <functional>
#include <string>

#include "terrain/fetch/fetched_area.h"

namespace belvedere {

// Text that stands first in a record: what its reader can use at once.
using RecordHead = std::function<std::string(const FetchedArea&)>;
// TOML that says of every map and tile where it comes from, after the head.
std::string fetch_record(const FetchParameters& parameters, const FetchedArea& area, const RecordHead& head = {});
// Writes it: whole or not at all. Error(output).
void write_fetch_record(const std::string& path, const FetchParameters& parameters, const FetchedArea& area, const RecordHead& head = {});

}  // namespace belvedere
