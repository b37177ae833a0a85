#include "tools/cli/terrain_operators.h"

#include <fmt/core.h>

#include "terrain/generalize/widen_valleys.h"
#include "terrain/shape/derivatives.h"

namespace belvedere::tools {

void add_terrain_operators(CommandOptions& command, TerrainOperators& operators) {
  command.add_flag("--destripe", operators.destripe,
                   "First removes stripes along rows and columns");
  command.add_flag("--line-integral", operators.line_integral,
                   "Then smooths slopes along slope lines and keeps ridges sharp (Jenny 2021)");
  command.add_option("--widen-valleys METRES", operators.widen_valleys_m,
                     "Last widens the floors of large valleys by this many metres");
  command
      .add_option("--hillshade FILE", operators.hillshade,
                  "Also writes the result's shaded relief, .tif")
      .files(FileUse::writes);
  const Option contours =
      command
          .add_option("--contours FILE", operators.contours,
                      "Also writes the result's contour lines, .gpkg, .geojson or .shp")
          .files(FileUse::writes, contour_files);
  command
      .add_option("--contour-interval METRES", operators.contour_interval_m,
                  "Metres between contour lines")
      .show_default()
      .needs(contours);
}

Grid<float> operate_after_bands(const Grid<float>& altitude_m, const Grid<std::uint8_t>& keep,
                                const Grid<float>& mask, double cell_m,
                                const TerrainOperators& operators, Progress& progress) {
  WidenValleysParameters valleys;
  valleys.width_m = operators.widen_valleys_m;
  return valleys.width_m == 0.F
             ? altitude_m
             : widen_valleys(altitude_m, keep, mask, cell_m, valleys, progress).altitude_m;
}

void write_products(const Raster<float>& result, const TerrainOperators& operators,
                    Progress& progress) {
  if (!operators.hillshade.empty()) {
    const GeoTransform& t = result.transform;
    write_raster(
        operators.hillshade,
        Raster<std::uint8_t>{hillshade(result.cells, t.cell_x, t.cell_y, {}), t, result.crs});
  }
  if (!operators.contours.empty()) {
    const ContourSummary lines =
        write_contours(operators.contours, result, {operators.contour_interval_m, 0.0});
    progress.note(fmt::format("{} contour lines, {:.0f} km", lines.lines, lines.length / 1000.0));
  }
}

void add_elevation_options(CommandOptions& command, ElevationOptions& options) {
  command
      .add_option("--encoding NAME", options.encoding,
                  "How the colours of map tiles encode heights: terrarium or mapbox (Terrain-RGB). "
                  "Default: the values are heights")
      .one_of({"terrarium", "mapbox"});
  command.add_option("--variable NAME", options.variable,
                     "Name of the raster with heights in a file that contains several (netCDF, "
                     "GeoPackage)");
}

RasterSource elevation_source(const std::string& path, const ElevationOptions& options) {
  RasterSource source;
  source.path = path;
  source.encoding = options.encoding;
  source.variable = options.variable;
  return source;
}

}  // namespace belvedere::tools
