#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Interface between GDAL (gdal/raster_file.cpp) and the resampling (warp.cpp). Private to terrain/.

// Cells of a file in its CRS: a corner-based affine map, which may be rotated, mirrored or
// south-up.
//   x = x0 + x_column · column + x_row · row        y = y0 + y_column · column + y_row · row
// Whole numbers are the corners of cells here; centres lie at .5.
struct CellAffine {
  double x0 = 0.0, x_column = 1.0, x_row = 0.0;
  double y0 = 0.0, y_column = 0.0, y_row = -1.0;

  glm::dvec2 to_crs(glm::dvec2 cell) const {
    return {x0 + x_column * cell.x + x_row * cell.y, y0 + y_column * cell.x + y_row * cell.y};
  }
  double determinant() const { return x_column * y_row - x_row * y_column; }
  glm::dvec2 to_cell(glm::dvec2 point) const {
    const double dx = point.x - x0;
    const double dy = point.y - y0;
    return {(y_row * dx - x_row * dy) / determinant(),
            (x_column * dy - y_column * dx) / determinant()};
  }
  bool axis_aligned() const { return x_row == 0.0 && y_column == 0.0; }
};

// The meaning of the band according to the file: heights or colours.
struct BandMeaning {
  bool palette = false;  // numbers of a table of colours
  bool colour = false;   // red, green or blue of a picture of 8 bits
  bool bytes = false;    // 0…255, without a scale
  std::string name;      // "red", for messages
};

// A rectangle of cells of a file: 0 <= x0, x0 + width <= the file's.
struct CellWindow {
  int x0 = 0, y0 = 0, width = 0, height = 0;
};

// Memory limit of the blocks of all open files, by the program's limit.
std::uint64_t raster_cache_bytes();

// An open raster file, one band of it. Not thread-safe. Throws as in raster_io.h.
class RasterFile {
 public:
  explicit RasterFile(const RasterSource& source);
  ~RasterFile();
  RasterFile(RasterFile&&) noexcept;
  RasterFile& operator=(RasterFile&&) noexcept;

  const RasterSource& source() const;
  int width() const;
  int height() const;
  int bands() const;
  const CellAffine& affine() const;
  const std::string& crs() const;  // WKT2, horizontal part only; empty if unknown
  // The same, or Error(input) with the key that sets it.
  const std::string& required_crs() const;
  std::optional<double> nodata() const;  // the scene's, else the file's
  // The nodata value as it was converted to the type of the cells, if that type cannot hold it;
  // else none.
  std::optional<double> wrapped_nodata() const;
  std::string driver() const;
  BandMeaning meaning() const;
  // Metres per foot if the file's CRS counts in feet and nothing says what its heights count in;
  // else 0.
  double undeclared_foot_m() const;
  // Values that were read so far and taken as void although neither header nor scene says so.
  std::vector<float> undeclared_voids() const;
  // The cells that were read so far and taken as void by max_spike_m.
  struct Spikes {
    std::size_t count = 0;
    bool more = false;  // than are counted
    int first_x = 0, first_y = 0;
    float first_m = 0.F;
  };
  Spikes spikes() const;

  // Metres, voids NaN; the window's own size.
  Grid<float> read_values(const CellWindow& window) const;
  // The window in `width` × `height` cells, each one of those under it (nearest neighbour); from
  // overviews if the file has some.
  Grid<float> read_values(const CellWindow& window, int width, int height) const;
  // Codes from 0 up, -1 for nodata.
  Grid<std::int32_t> read_codes(const CellWindow& window) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The centre of a raster, in the file's CRS.
inline glm::dvec2 centre_of(const RasterFile& file) {
  return file.affine().to_crs({0.5 * file.width(), 0.5 * file.height()});
}

// Tiles of map services hold heights as colours of 8 bits:
//   height_m = base_m + step_m · (65536 red + 256 green + blue)
struct HeightEncoding {
  double base_m = 0.0;
  double step_m = 1.0;

  float metres(std::uint8_t red, std::uint8_t green, std::uint8_t blue) const {
    return static_cast<float>(base_m + step_m * (65536.0 * red + 256.0 * green + blue));
  }
};

// "terrarium" (Mapzen's Terrain Tiles) or "mapbox" (Mapbox Terrain-RGB); nothing for other words.
inline std::optional<HeightEncoding> height_encoding(const std::string& name) {
  if (name == "terrarium") return HeightEncoding{-32768.0, 1.0 / 256.0};
  if (name == "mapbox") return HeightEncoding{-10000.0, 0.1};
  return std::nullopt;
}

// For messages: what to write where colours encode heights.
constexpr const char* encoding_advice =
    "if its colours encode heights, `encoding = \"terrarium\"` or \"mapbox\" (--encoding where "
    "there is no scene)";

// All files that a raster is read from, itself first: its sidecar files (.prj, .tfw, .hdr, .aux.xml
// …), changes beside a database (-wal), and for a VRT its sources with their sidecar files. Each
// once, in alphabetical order. A URL has only itself. Opens them as raster_io.h does.
std::vector<std::string> raster_parts(const std::string& path);
// The same of vectors and tables: those of a shapefile (.dbf, .shx, .prj, .cpg), and changes beside
// a database. Opens nothing.
std::vector<std::string> vector_parts(const std::string& path);

// An array of numbers with named dimensions, as in netCDF files; the last dimension is contiguous.
struct NumberArray {
  std::string name;
  std::vector<std::string> dimensions;
  std::vector<std::size_t> sizes;
  std::vector<double> values;  // scaled as specified by the file; NaN if missing
  std::string unit;            // "degC", "days since 1801-10-01"; empty if not given
};

// The named arrays of a netCDF file, in the requested order; nothing for names that the file lacks.
// Throws Error(input) naming the file: missing, of another format, damaged; Error(limit), before
// allocating, if an array would not fit into memory.
std::vector<std::optional<NumberArray>> read_number_arrays(const std::string& path,
                                                           const std::vector<std::string>& names);

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
