#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "terrain/io/dem.h"

namespace belvedere {

// Positions of a scene, in the DEM's CRS. `key` is the scene's, for messages. Throw Error(usage)
// where a terrain has no CRS.
glm::dvec2 position_of_lonlat(const Dem& dem, glm::dvec2 lonlat, const std::string& key);
// The position in whichever of the two forms is given; `key` names the table that holds both.
// Error(usage) where it has neither.
glm::dvec2 resolve_place(const Dem& dem, const std::optional<glm::dvec2>& position,
                         const std::optional<glm::dvec2>& position_lonlat, const std::string& key);

}  // namespace belvedere
