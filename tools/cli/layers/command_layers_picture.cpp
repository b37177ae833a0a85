#include <fmt/core.h>

#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "terrain/io/raster_file.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layer_picture.h"
#include "terrain/layers/layers_file.h"
#include "tools/cli/commands.h"
#include "tools/cli/layers/ground_climate_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

struct LayersPictureOptions : RunOptions {
  std::string layers, dem, out;
  ElevationOptions elevation;
  GroundClimateOptions climate;
  LayerPictureParameters picture;
};

Grid<std::uint8_t> band(const Grid<glm::vec3>& rows, int c) {
  Grid<std::uint8_t> bytes(rows.width(), rows.height());
  for (std::size_t i = 0; i < rows.size(); ++i)
    bytes[i] = static_cast<std::uint8_t>(rows[i][c] + 0.5F);
  return bytes;
}

int run(const LayersPictureOptions& options) {
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const LayerPictureParameters& parameters = options.picture;
  check_layer_picture(parameters);
  const SurfaceLayers layers = read_surface_layers(options.layers);
  const Dem dem = read_layer_dem(options.dem, options.elevation, progress);
  const int finer = parameters.finer;
  const GeoTransform& cells = dem.transform;
  const RasterFrame frame{
      {cells.origin_x, cells.origin_y, cells.cell_x / finer, cells.cell_y / finer},
      dem.width() * finer,
      dem.height() * finer,
      dem.crs};
  const LayerClimateGrids climate =
      climate_of(options.climate, dem, compile_layers(layers).inputs, progress);
  ByteRasterRows picture(options.out, {.frame = frame, .bands = {{}, {}, {}}, .is_colour = true});
  draw_layer_picture(
      layers, dem, climate.view(), parameters,
      [&](int y0, const Grid<glm::vec3>& rows) {
        picture.write(y0, {band(rows, 0), band(rows, 1), band(rows, 2)});
      },
      progress);
  progress.begin("writing", 0.0);
  picture.prepare();
  picture.commit();
  progress.end();
  print_result(options,
               Json::object()
                   .add("out", Json::text(options.out))
                   .add("width", Json::number(frame.width))
                   .add("height", Json::number(frame.height))
                   .add("cell", Json::number(frame.transform.cell_x)),
               fmt::format("{}: {}×{} pixels of {:g} m\n", options.out, frame.width, frame.height,
                           frame.transform.cell_x));
  return 0;
}

}  // namespace

Action add_layers_picture(CommandOptions& command) {
  const auto options = std::make_shared<LayersPictureOptions>();
  LayerPictureParameters& picture = options->picture;
  command.add_option("LAYERS FILE", options->layers, "The layers: a .toml file (docs/layers.md)")
      .required()
      .files(FileUse::input);
  command.add_option("--dem FILE", options->dem, "The ground: a DEM")
      .required()
      .files(FileUse::input);
  add_elevation_options(command, options->elevation);
  command.add_option("--out TIF", options->out, "The picture: a GeoTIFF of three bands")
      .required()
      .files(FileUse::writes);
  command.add_option("--finer N", picture.finer,
                     "Pixels per cell of the DEM, across and down; 1 to 16. Default: 4");
  command.add_option("--light-from DEG", picture.light_from,
                     "Direction the light comes from, degrees clockwise from north. Default: 315");
  add_ground_climate(command, options->climate);
  command.add_option("--seed N", picture.seed, "Random seed of the layers' grain. Default: 1");
  add_run_options(command, *options);
  command.footer(
      "The ground seen from above, finer than the DEM: a smooth surface through its cells, with "
      "the layers' colours and bumps.\n"
      "\n"
      "  belvedere layers picture innsbruck.layers.toml --dem innsbruck.tif --finer 4 --out "
      "map.tif");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
