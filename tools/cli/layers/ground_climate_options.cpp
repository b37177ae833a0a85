#include "tools/cli/layers/ground_climate_options.h"

#include <glm/vec2.hpp>

#include "base/error.h"
#include "terrain/climate/climate.h"
#include "terrain/climate/default_climate.h"
#include "terrain/climate/radiation.h"
#include "terrain/io/raster_io.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

// Moves a raster of months from the files, which are used unchanged, to the climate, which handles
// months.
std::optional<RasterSource> monthly(std::string& file) {
  constexpr int months = 12;
  if (file.empty()) return {};
  RasterSource source;
  source.path = file;
  if (read_raster_info(source).bands < months) return {};
  file.clear();
  return source;
}

}  // namespace

void add_ground_climate(CommandOptions& command, GroundClimateOptions& options) {
  command
      .add_option("--stations FILE", options.stations,
                  "Weather stations, for temperature and rain: CSV, points or netCDF "
                  "(docs/climate.md). Default: the climate of the place")
      .files(FileUse::input);
  command
      .add_option(
          "--temperature FILE", options.files.temperature,
          "Alternative: annual mean temperature, °C, a raster of one band; 12 bands: monthly means")
      .files(FileUse::input);
  command
      .add_option("--rain FILE", options.files.rain,
                  "Alternative: annual precipitation, mm, a raster of one band; 12 bands: monthly")
      .files(FileUse::input);
  command
      .add_option(
          "--radiation FILE", options.files.radiation,
          "Potential direct radiation of the year, instead of the computed one, MJ/m²: a raster")
      .files(FileUse::input);
  command
      .add_option("--sky-view FILE", options.files.sky_view,
                  "Sky view factor, 0 … 1, instead of the computed one: a raster")
      .files(FileUse::input);
  command
      .add_option("--sunshine SHARES", options.sunshine,
                  "Clouds in the computed radiation: share of the day with sunshine, 0 … 1, of all "
                  "months or of January,…,December. Default: 1, a clear sky")
      .list(',');
  command.add_option("--latitude DEG", options.latitude_deg,
                     "Latitude, for a DEM without a coordinate system whose sun or climate is "
                     "computed, degrees");
}

Dem read_layer_dem(const std::string& path, const ElevationOptions& options, Progress& progress) {
  DemParameters parameters;
  parameters.max_void_share = 1.0;
  const RasterSource source = elevation_source(path, options);
  parameters.sources = {source};
  return read_raster_info(source).crs.empty() ? read_own_dem(source, progress)
                                              : read_dem(parameters, progress);
}

LayerClimateGrids climate_of(const GroundClimateOptions& options, const Dem& dem,
                             const std::vector<std::string>& names, Progress& progress) {
  LayerClimateFiles files = options.files;
  ClimateParameters parameters;
  parameters.stations = options.stations;
  parameters.temperature = monthly(files.temperature);
  parameters.rain = monthly(files.rain);
  parameters.latitude_deg = options.latitude_deg;
  if (options.latitude_deg && !(*options.latitude_deg >= -90.0 && *options.latitude_deg <= 90.0))
    throw Error(ErrorKind::usage, "--latitude", std::to_string(*options.latitude_deg), "-90 … 90");
  if (dem.crs.empty() && !options.latitude_deg && needs_place(names, files))
    throw Error(ErrorKind::usage, "--latitude",
                "sun and climate depend on the latitude, but the DEM has no coordinate system",
                "its latitude, -90 … 90");
  const auto climate = [&] {
    return make_climate(
        dem, parameters,
        [](glm::dvec2 lonlat_deg) { return default_climate(lonlat_deg.x, lonlat_deg.y); },
        progress);
  };
  return make_layer_climate(dem, names, files, options.latitude_deg, climate, progress, nullptr, {},
                            shares_of_months(options.sunshine, "--sunshine"));
}

}  // namespace belvedere::tools
