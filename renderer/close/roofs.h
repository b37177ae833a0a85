#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

#include "base/parallel.h"
#include "base/pixel_rect.h"
#include "renderer/rock/spurs.h"

namespace belvedere {

// Forms of open ground seen from near: the highest of many low roofs, as spurs of rock are, one to
// a jittered cell of the sheet.
struct RoofSize {
  float spacing_units = 30.0F;  // mean distance
  float slender = 0.5F;         // factor on lengths along a roof: small is long, .2…1
  float lean_rad = 0.25F;       // deviation of their directions
};

// Roofs that start at wide pixels for which `direction` gives one: unit, on the sheet. `part`
// separates sizes. The same for any rectangle of the sheet (px), within roof_reach_units of it.
SpurCells grow_roofs(const SpurGround& ground, const RoofSize& size, std::uint64_t part,
                     PixelRect sheet_rect,
                     FunctionRef<std::optional<glm::vec2>(std::size_t wide_pixel)> direction);
float roof_reach_units(const RoofSize& size);

}  // namespace belvedere
