#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>

#include "terrain/io/crs.h"
#include "terrain/io/raster.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {

// Rasters in a folder of the test's own.
class RasterFiles : public testing::Test {
 protected:
  static RasterSource source_of(const std::string& path, const std::string& crs = {}) {
    RasterSource source;
    source.path = path;
    source.crs = crs;
    return source;
  }
  // Hills of a few hundred metres over a kilometre, in metres of any CRS.
  static float hills(double x, double y) {
    return static_cast<float>(1000.0 + 200.0 * std::sin(x / 300.0) * std::cos(y / 400.0) +
                              0.01 * x);
  }
  static Raster<float> make_hills(int width, int height, GeoTransform transform,
                                  const std::string& crs) {
    Raster<float> raster{Grid<float>(width, height), transform, normalize_crs(crs)};
    for (const auto [x, y] : test::cells(width, height)) {
      const glm::dvec2 p = transform.to_crs(x, y);
      raster.cells(x, y) = hills(p.x, p.y);
    }
    return raster;
  }
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
