#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/grid.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Meaning of the bytes of a raster.
struct ByteRasterLayout {
  RasterFrame frame = {};
  struct Band {
    std::string name;
    double scale = 1.0;  // value = byte · scale
  };
  std::vector<Band> bands = {};
  bool is_colour = false;  // three bands red, green, blue
  bool zero_is_void = false;
  // Names and colours of codes, for one band; empty: none.
  struct Code {
    std::uint8_t code;
    std::string name;
    std::uint32_t rgb;
  };
  std::vector<Code> codes = {};
};

// A GeoTIFF of bytes (tiled, deflate) that is written row by row, so that it need not fit into
// memory. It is written atomically: under a temporary name first, read back and compared, then
// renamed; without commit() nothing remains. Throws Error(output).
class ByteRasterRows {
 public:
  ByteRasterRows(const std::string& path, const ByteRasterLayout& layout);
  ~ByteRasterRows();
  ByteRasterRows(const ByteRasterRows&) = delete;
  ByteRasterRows& operator=(const ByteRasterRows&) = delete;

  // The rows from y0 on, one grid of the frame's width for each band. From the top down, without
  // gaps; multiples of 256 rows compress best.
  void write(int y0, const std::vector<Grid<std::uint8_t>>& bands);
  // All rows are there: flushed to disk and read back. To write several files that belong together,
  // prepare all before the first commit.
  void prepare();
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
