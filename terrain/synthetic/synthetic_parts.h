#pragma once

#include <cstddef>
#include <cstdint>

namespace belvedere::synthetic {

// Cells are kept as 32-bit indices, half the memory; where a grid is read they are its own.
inline std::size_t at(std::int32_t cell) { return static_cast<std::size_t>(cell); }

}  // namespace belvedere::synthetic
