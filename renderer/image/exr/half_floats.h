#pragma once

#include <cstddef>
#include <cstdint>

namespace belvedere {

// Numbers as the 16 bits of OpenEXR files, rounded to the nearest; finite numbers beyond ±65504 are
// clamped. `count` values each step apart.
void to_halves(const float* from, std::size_t step, std::size_t count, std::uint16_t* to);
// The exact inverse.
void from_halves(const std::uint16_t* from, std::size_t count, float* to, std::size_t step);

}  // namespace belvedere
