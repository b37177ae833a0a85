#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"

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

// Fixed tiles of one product of the sheet, kept until they are dropped: in memory up to the store's
// share, then in an unnamed scratch file, so that nothing is left of it however the program ends.
// All tiles have the same planes; those at the right and bottom edge are smaller. A tile may hold
// only a rectangle; the rest of it is then never requested.
class TileStore {
 public:
  // Shared by several stores: a folder for scratch files, and the bytes of memory that the tiles of
  // all of them may take.
  struct Place {
    std::string folder;
    std::uint64_t memory_bytes = 0;  // still free
  };
  // value_bytes: of each plane. `scratch` must outlive the store.
  TileStore(Place& scratch, int sheet_width, int sheet_height, int tile_px,
            std::vector<std::size_t> value_bytes);
  ~TileStore();
  TileStore(const TileStore&) = delete;
  TileStore& operator=(const TileStore&) = delete;

  int across() const { return across_; }
  int down() const { return down_; }
  PixelRect rect(int column, int row) const;
  // Whether a tile holds this rectangle of the sheet, which lies inside it.
  bool has(int column, int row, PixelRect part) const;
  // Sets the content of a tile: all planes, of the size of `held`, a rectangle of the sheet inside
  // the tile. Error(output) if the scratch file cannot grow.
  void put(int column, int row, PixelRect held, const Planes& planes);
  // Copies `from` (a rectangle of the sheet that the tile holds) into grids whose pixel (0, 0) is
  // the sheet's `origin`. wanted[i] is for plane i; empty ones are skipped.
  void get(int column, int row, PixelRect from, int origin_x, int origin_y,
           const Planes& wanted) const;
  // Drops tiles that will not be requested again.
  void drop(int column, int row);

 private:
  struct Tile {
    std::unique_ptr<std::byte[]> memory;  // planes one after the other, or
    std::size_t memory_bytes = 0;
    std::int64_t slot = -1;  // slot in the scratch file; -1: none
    PixelRect held;          // empty: nothing
  };
  Tile& tile(int column, int row);
  const Tile& tile(int column, int row) const;

  Place& scratch_;
  int width_;
  int height_;
  int tile_px_;
  int across_;
  int down_;
  std::vector<std::size_t> value_bytes_;
  std::size_t slot_bytes_ = 0;
  std::vector<Tile> tiles_;
  std::vector<std::int64_t> free_slots_;
  std::int64_t slots_ = 0;
  int file_ = -1;
};

// Reads or writes all bytes at a position of an open file, despite interruptions and partial
// transfers. Returns 0 or an errno: no space where no more can be written, a read error where the
// file ends early.
int write_bytes_at(int file, const std::byte* bytes, std::size_t count, std::uint64_t at);
int read_bytes_at(int file, std::byte* bytes, std::size_t count, std::uint64_t at);

}  // namespace belvedere
