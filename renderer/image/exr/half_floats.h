#pragma once

#include <cstddef>
#include <cstdint>

namespace belvedere {

// Numbers as the 16 bits that OpenEXR files hold, rounded to the nearest; never infinite where the number was not: beyond ±65504 they are
// cut to that. `count` values each step apart.
void to_halves(const float* from, std::size_t step, std::size_t count, std::uint16_t* to);
// Back, exactly.
void from_halves(const std::uint16_t* from, std::size_t count, float* to, std::size_t step);

}  // namespace belvedere
