#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// The grids of a product, of any type, as a store of tiles copies them. Values must be trivially
// copyable.
struct Plane {
  std::byte* values = nullptr;
  std::size_t value_bytes = 0;
  int width = 0;
  int height = 0;
  std::size_t row_bytes() const { return value_bytes * static_cast<std::size_t>(width); }
  std::size_t bytes() const { return row_bytes() * static_cast<std::size_t>(height); }
};
using Planes = std::vector<Plane>;

template <class T>
Plane plane_of(Grid<T>& grid) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {grid.empty() ? nullptr : reinterpret_cast<std::byte*>(grid.data()), sizeof(T),
          grid.width(), grid.height()};
}

}  // namespace belvedere
