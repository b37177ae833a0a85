#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>

#include "terrain/io/raster.h"
#include "tests/files.h"

namespace belvedere {

// Rasters in a folder of the test's own.
class RasterFiles : public testing::Test {
 protected:
  void TearDown() override { unsetenv("BELVEDERE_MEMORY_MIB"); }
  std::string path(const std::string& name) const { return folder_ / name; }
  std::string write_text(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  std::string read_text(const std::string& name) const { return test::read_bytes(path(name)); }
  // An ESRI ASCII grid of 1-unit cells, its lower left corner at (x, y); it needs no .prj file,
  // because sources can set their CRS.
  std::string write_ascii(const std::string& name, int width, int height, double x, double y,
                          double cell, const std::function<std::string(int, int)>& value,
                          const std::string& nodata = "") const {
    std::ostringstream text;
    text.precision(17);
    text << "ncols " << width << "\nnrows " << height << "\nxllcorner " << x << "\nyllcorner " << y
         << "\ncellsize " << cell << '\n';
    if (!nodata.empty()) text << "NODATA_value " << nodata << '\n';
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column)
        text << (column == 0 ? "" : " ") << value(column, row);
      text << '\n';
    }
    return write_text(name, text.str());
  }

  test::Folder folder_;
};

using test::error_of;

}  // namespace belvedere
