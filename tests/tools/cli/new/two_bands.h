#pragma once

#include <string>

#include "terrain/io/raster_file.h"

namespace belvedere::test {

// A file whose second band holds codes of land cover, and whose first has codes of no legend.
inline void write_two_bands(const std::string& path, const Raster<float>& codes) {
  Grid<std::uint8_t> bytes(codes.cells.width(), codes.cells.height());
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = static_cast<std::uint8_t>(codes.cells[i]);
  const Grid<std::uint8_t> nothing(bytes.width(), bytes.height(), 7);
  ByteRasterRows file(path, {.frame = {codes.transform, bytes.width(), bytes.height(), codes.crs},
                             .bands = {{"nothing"}, {"codes"}}});
  file.write(0, {nothing, bytes});
  file.commit();
}

}  // namespace belvedere::test
