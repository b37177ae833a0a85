#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "renderer/image/image_io.h"
#include "terrain/generalize/destripe.h"
#include "terrain/generalize/mask.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/generalize/line_integral_generalize.h"
#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"
#include "tools/cli/commands.h"
#include "tools/cli/generalize_options.h"
#include "tools/cli/terminal.h"
#include "tools/cli/terrain_operators.h"
#include "tools/options/options.h"
#include "tools/report/generalize_report_page.h"

namespace belvedere::tools {
namespace {

// Before the work: errors that would prevent writing the result.
void check_dem_name(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (extension != ".tif" && extension != ".tiff" && extension != ".asc")
    refuse(path, "is not the name of a DEM that can be written", ".tif or .asc");
}

// Distances between which foreground turns into background. Default: a quarter and three quarters
// of the distance to the farthest corner.
glm::dvec2 blend_distances(const GeneralizeOptions& options, const Dem& dem, glm::dvec2 viewer_cell,
                           glm::dvec2 cell_m) {
  if (!options.distances.empty()) {
    const glm::dvec2 written(options.distances[0], options.distances[1]);
    if (!(written.x >= 0.0 && written.x < written.y)) {
      refuse("--distances", fmt::format("from {} to {} m", written.x, written.y),
             "two distances, the nearer first");
    }
    return written;
  }
  double farthest = 1.0;
  for (const double x : {0.0, dem.width() - 1.0}) {
    for (const double y : {0.0, dem.height() - 1.0})
      farthest = std::max(
          farthest, std::hypot((x - viewer_cell.x) * cell_m.x, (y - viewer_cell.y) * cell_m.y));
  }
  return {0.25 * farthest, 0.75 * farthest};
}

// u_d of equation 5.
Grid<float> share_by_distance(const GeneralizeOptions& options, const Dem& dem, glm::dvec2 cell_m) {
  if (options.viewer.empty()) return {};
  const glm::dvec2 at = dem.transform.to_cell(options.viewer[0], options.viewer[1]);
  const auto distance_m = [&](double x, double y) {
    return std::hypot((x - at.x) * cell_m.x, (y - at.y) * cell_m.y);
  };
  const glm::dvec2 blend = blend_distances(options, dem, at, cell_m);
  const double near = blend.x;
  const double far = blend.y;
  Grid<float> share(dem.width(), dem.height());
  parallel_rows(dem.height(), [&](int y) {
    for (int x = 0; x < dem.width(); ++x) {
      share(x, y) = static_cast<float>(foreground_share(distance_m(x, y), near, far));
    }
  });
  return share;
}

Grid<float> make_foot_mask(const Dem& dem, glm::dvec2 cell_m, std::size_t bands) {
  return slope_foot_mask(dem.altitude_m, cell_m, 1 << std::min<std::size_t>(bands, 6));
}

Grid<float> drawn_mask(const GeneralizeOptions& options, const Dem& dem, Progress& progress) {
  if (options.mask.empty()) return {};
  RasterSource source;
  source.path = options.mask;
  return soften_mask(
      read_mask(source, {dem.transform, dem.width(), dem.height(), dem.crs}, progress));
}

Grid<float> make_mask(const GeneralizeOptions& options, const Dem& dem, glm::dvec2 cell_m,
                      Progress& progress) {
  Grid<float> mask;
  if (const auto range = masked_slopes(options)) mask = slope_mask(dem.altitude_m, cell_m, *range);
  return combine_masks(std::move(mask), drawn_mask(options, dem, progress));
}

int run(const GeneralizeOptions& options) {
  const GeneralizeParameters bands = resolve_bands(options);
  check_dem_name(options.out);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  progress.begin("reading", 0.0);
  const RasterSource source = elevation_source(options.in, options.elevation);
  const std::optional<double> nodata =
      read_raster_info(source).nodata;  // voids keep their nodata value
  Dem dem = read_own_dem(source, progress);
  const glm::dvec2 cell_m = ground_cell_m(dem.transform, dem.crs, dem.width(), dem.height());
  const bool true_cells = cell_m == glm::dvec2(dem.transform.cell_x, dem.transform.cell_y);
  if (!true_cells) {
    progress.note(fmt::format("a cell is {:.1f} × {:.1f} m on the ground at the centre of the DEM",
                              cell_m.x, cell_m.y));
    const bool wants_metres =
        options.operators.line_integral || options.operators.widen_valleys_m > 0.F ||
        !options.operators.hillshade.empty() || !options.operators.contours.empty();
    if (wants_metres) {
      refuse(options.in,
             "its cells are not in metres, which slope lines, valleys, shaded relief and contours "
             "need",
             "a DEM in a metric coordinate system (gdalwarp -t_srs EPSG:326xx); weights of bands "
             "work in any system");
    }
  }
  if (dem.crs.empty())
    progress.note("the DEM has no coordinate system: its cells are taken as metres");

  const double cell = 0.5 * (cell_m.x + cell_m.y);
  const Grid<float> original_m = options.report.empty() ? Grid<float>() : dem.altitude_m;
  // Of the data, so for masks too.
  if (options.operators.destripe) dem.altitude_m = destripe(dem.altitude_m, {}, progress);
  GeneralizeGrids grids;
  // First, because it needs the most memory.
  if (masks_slope_feet(options))
    grids.amplification_mask = make_foot_mask(dem, cell_m, bands.foreground.size());
  if (!options.change_lakes) grids.keep = find_lakes(dem.altitude_m, {});
  grids.mask = make_mask(options, dem, cell_m, progress);
  grids.foreground_share = share_by_distance(options, dem, cell_m);
  Grid<float> plain_m;
  if (options.operators.line_integral)
    plain_m = generalize_along_slope_lines(dem.altitude_m, grids.mask, cell, {}, progress);
  Grid<float> result_m =
      generalize(plain_m.empty() ? dem.altitude_m : plain_m, cell_m, grids, bands, progress);
  plain_m = {};
  result_m =
      operate_after_bands(result_m, grids.keep, grids.mask, cell, options.operators, progress);

  if (!options.report.empty()) {
    write_generalize_report(options.report,
                            {.title = file_name(options.in),
                             .command = describe_generalize(options, bands),
                             .before_m = original_m,
                             .after_m = result_m,
                             .cell_m = cell_m,
                             .grids = grids,
                             .parameters = bands},
                            progress);
  }
  progress.begin("writing", 0.0);
  double sum = 0.0;
  double largest = 0.0;
  std::size_t cells = 0;
  for (std::size_t i = 0; i < result_m.size(); ++i) {
    if (dem.filled[i] != 0) {
      result_m[i] = std::numeric_limits<float>::quiet_NaN();  // a void stays a void
      continue;
    }
    const double change = static_cast<double>(result_m[i]) - dem.altitude_m[i];
    sum += change * change;
    largest = std::max(largest, std::abs(change));
    ++cells;
  }
  const Raster<float> result{std::move(result_m), dem.transform, dem.crs};
  write_raster(options.out, result, nodata);
  write_products(result, options.operators, progress);
  const double mean = std::sqrt(sum / static_cast<double>(cells));
  progress.note(fmt::format("altitudes change by {:.1f} m (root mean square), at most {:.1f} m",
                            mean, largest));
  progress.end();
  if (options.json) {
    print_out(Json::object()
                  .add("out", Json::text(options.out))
                  .add("width", Json::number(result.cells.width()))
                  .add("height", Json::number(result.cells.height()))
                  .add("bands", Json::number(static_cast<double>(bands.foreground.size())))
                  .add("rms_change_m", Json::number(mean))
                  .add("largest_change_m", Json::number(largest))
                  .str() +
              "\n");
  }
  return 0;
}

}  // namespace

Action add_generalize(CommandOptions& command) {
  const auto options = std::make_shared<GeneralizeOptions>();
  add_generalize_options(command, *options);
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
