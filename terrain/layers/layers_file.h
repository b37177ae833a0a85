#pragma once

#include <string>
#include <string_view>

#include "terrain/layers/surface_layers.h"

namespace belvedere {

// Surface layers as TOML (docs/layers.md). Layers may be in any order: they are returned depth
// first, siblings in the order of the file. Error(usage) with file:line:column for unknown keys,
// inputs and classes with the closest known one, missing parents, layers that are their own
// ancestors, samples that are not 2…256 bytes, and errors in expressions.
SurfaceLayers parse_surface_layers(std::string_view text, const std::string& where);
// A .toml file; Error(input) if it is missing.
SurfaceLayers read_surface_layers(const std::string& path);

// The text of a file that reads back as the same value, to the bit.
std::string surface_layers_text(const SurfaceLayers& layers);

}  // namespace belvedere
