#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// Raises hollows to the level at which they spill on their best way to an outlet, a cell by its index; outlets and everything else stay.
// What a flood from the outlets ends in, which takes the lowest cell beside the water next (Barnes, Lehman & Mulla 2014). At least one
// outlet; cells finite, fewer than 2^31. The same bits for any number of threads.
void fill_to_spill_level(Grid<float>& altitude_m, std::span<const std::int32_t> outlets);
// The same with scratch memory of the caller, whose values do not matter: for repeated calls.
void fill_to_spill_level(Grid<float>& altitude_m, std::span<const std::int32_t> outlets, std::vector<std::int32_t>& memory);

}  // namespace belvedere
