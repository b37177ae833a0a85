#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// Raises hollows to the level at which they spill on their best path to an outlet. Outlets are
// cells by index; they and everything else are unchanged. Equal to the result of a priority flood
// from the outlets (Barnes, Lehman & Mulla 2014). At least one outlet; cells finite, fewer than
// 2^31. The same bits for any number of threads.
void fill_to_spill_level(Grid<float>& altitude_m, std::span<const std::int32_t> outlets);
// The same with scratch memory of the caller, whose values are ignored: for repeated calls.
void fill_to_spill_level(Grid<float>& altitude_m, std::span<const std::int32_t> outlets,
                         std::vector<std::int32_t>& memory);

}  // namespace belvedere
