#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster.h"

namespace belvedere {

// One raster file and its settings in a scene.
struct RasterSource {
  std::string path;
  int band = 1;               // from 1; of the raster `variable`
  std::string variable = {};  // name of the raster in a file of several; empty: the only one
  // How colours encode the heights (height_encoding.h); empty: the values are heights.
  std::string encoding = {};
  std::string
      crs;  // overrides or supplies the file's CRS ("EPSG:26911" or WKT); empty: the file's own
  double unit_to_m = 0.0;        // metres per unit of the values; 0: by the band's unit (feet are
                                 // recognized), metres if it has none
  std::optional<double> nodata;  // overrides the file's
  // Altitudes beyond these are void: for files with plausible-looking wrong values.
  std::optional<double> lowest_m, highest_m;
  // Cells that are higher or lower than all eight around them by more than this are void; 0: kept.
  double max_spike_m = 0.0;
};

// A file's metadata, without reading its cells.
struct RasterInfo {
  int width = 0;
  int height = 0;
  int bands = 0;
  GeoTransform transform;
  std::string crs;  // WKT2, empty if unknown
  bool geographic = false;
  std::optional<double> nodata;
  std::string driver;
};

// A frame to warp into: a metric CRS, its cells.
struct RasterFrame {
  GeoTransform transform;
  int width = 0;
  int height = 0;
  std::string crs;
};

// Every function throws Error(input) naming the file: missing, a driver that is not on the
// allow-list (GTiff, AAIGrid, SRTMHGT, HFA, ENVI, netCDF, PNG, VRT only with the extension .vrt,
// …), damaged, a failed read, no CRS (with the key that sets it); Error(limit), before allocating,
// if it would not fit into memory.
RasterInfo read_raster_info(const RasterSource& source);

// Cells as floats in metres. NaN for nodata, for -9999, -32768 and 32767 if the file declares none,
// and always for -32768. No reprojection; a south-up raster is flipped, a rotated one resampled
// upright in its own CRS.
Raster<float> read_raster(const RasterSource& source, Progress& progress = silent_progress());
// Integer codes; nodata becomes -1.
Raster<std::int32_t> read_codes(const RasterSource& source);

// Several sources, reprojected and mosaicked into one frame; earlier sources take precedence, later
// ones fill their voids. Files whose cells lie on one lattice join without a seam. Cubic
// convolution limited to the range of the cells it reads, an average if the source is finer;
// coinciding cells are copied to the bit. Values in metres.
Raster<float> warp_rasters(const std::vector<RasterSource>& sources, const RasterFrame& frame,
                           Progress& progress);
// Nearest neighbour; cells without a source are -1.
Raster<std::int32_t> warp_codes(const std::vector<RasterSource>& sources, const RasterFrame& frame,
                                Progress& progress);

// The frame that contains all sources at their own resolution: the CRS of the first if it is metric
// (crs empty), else its UTM zone, or the given CRS; cell_m 0 means the finest source's. extent: min
// x, min y, max x, max y in that CRS, optional.
RasterFrame choose_frame(const std::vector<RasterSource>& sources, const std::string& crs,
                         double cell_m, const std::optional<std::array<double, 4>>& extent);

// GeoTIFF (tiled, deflate) or ESRI ASCII by the extension; temporary file and rename. Voids are
// written as `nodata`, or as -9999 if none is given, if it is the altitude of a cell or if the
// format cannot represent it.
void write_raster(const std::string& path, const Raster<float>& raster,
                  std::optional<double> nodata = {});
// GeoTIFF of bytes, 0 for voids.
void write_raster(const std::string& path, const Raster<std::uint8_t>& raster);
// The files that it writes: for .asc also a .prj.
std::vector<std::string> raster_files(const std::string& path);

// The result of warp_rasters for a frame, window by window, equal to the bit for any window: for
// frames that are larger than memory. The files stay open; not thread-safe. Throws as warp_rasters
// does.
class RasterWindows {
 public:
  RasterWindows(const std::vector<RasterSource>& sources, const RasterFrame& frame);
  ~RasterWindows();
  RasterWindows(const RasterWindows&) = delete;
  RasterWindows& operator=(const RasterWindows&) = delete;

  const RasterFrame& frame() const { return frame_; }
  // Values in metres, voids NaN. The window must lie inside the frame.
  Grid<float> read(const PixelRect& window);
  // Notes on the cells that were taken as void so far though no header says so.
  void note_dropped(Progress& progress) const;

 private:
  struct State;
  RasterFrame frame_;
  std::unique_ptr<State> state_;
};

struct ContourParameters {
  double interval_m = 100.0;  // between lines; > 0
  double base_m = 0.0;        // altitude of one of the lines
};

// Summary of the contours written, for reports: their length falls as terrain is generalized.
struct ContourSummary {
  int lines = 0;
  double length = 0.0;  // in CRS units (m)
};

// Contour lines as a GeoPackage (.gpkg), GeoJSON (.geojson, in the raster's CRS) or shapefile
// (.shp), with the attribute altitude_m. Voids (NaN) have none. An existing file is replaced only
// when all is written. Throws Error(usage) for an invalid interval, Error(output) naming the file.
ContourSummary write_contours(const std::string& path, const Raster<float>& raster,
                              const ContourParameters& parameters);
// The files that it writes: for .shp several.
std::vector<std::string> contour_files(const std::string& path);

}  // namespace belvedere
