#pragma once

#include <cstddef>
#include <cstdint>

namespace belvedere::synthetic {

// Cells are stored as 32-bit indices, which halves their memory; a grid is indexed with
// std::size_t.
inline std::size_t at(std::int32_t cell) { return static_cast<std::size_t>(cell); }

}  // namespace belvedere::synthetic
