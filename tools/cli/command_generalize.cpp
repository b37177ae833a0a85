#include "tools/cli/command_generalize.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "renderer/image/image_io.h"
#include "terrain/generalize/destripe.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/generalize/line_integral_generalize.h"
#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/report/generalize_report_page.h"

namespace belvedere::tools {
namespace {

using Weights = std::vector<float>;

void check_set(const char* option, const Weights& weights, std::size_t bands, float min) {
  if (weights.empty()) return;
  if (weights.size() != bands) {
    refuse(option, fmt::format("{} weights", weights.size()),
           fmt::format("as many as --global has, {}", bands));
  }
  for (const float w : weights)
    if (!(w >= min && w <= 5.F))
      refuse(option, fmt::format("a weight of {}", w), fmt::format("{} … 5; 1 keeps a band", min));
}

std::string preset_lines() {
  std::string out;
  for (const GeneralizePreset& preset : generalize_presets())
    out += fmt::format("  {:<14} {}\n", preset.name, preset.meaning);
  return out;
}

void add_weights(CommandOptions& command, const std::string& name, Weights& weights,
                 const char* meaning) {
  command.add_option(name + " W1,…,WN", weights, meaning).list(',');
}

// Options of the run other than weights and masks, as typed, each with a space before it: how break
// lines are found, and the operators before and after the bands.
std::string describe_operators(const GeneralizeOptions& options,
                               const GeneralizeParameters& bands) {
  const GeneralizeParameters usual;
  std::string out;
  if (bands.base != usual.base) out += fmt::format(" --base {}", bands.base);
  if (bands.curvature == CurvatureForm::plan) out += " --curvature plan";
  if (bands.full_curvature != usual.full_curvature)
    out += fmt::format(" --full-curvature {}", bands.full_curvature);
  if (bands.blur_cells != usual.blur_cells) out += fmt::format(" --blur {}", bands.blur_cells);
  if (bands.exponent != usual.exponent) out += fmt::format(" --exponent {}", bands.exponent);
  if (options.operators.destripe) out += " --destripe";
  if (options.operators.line_integral) out += " --line-integral";
  if (options.operators.widen_valleys_m > 0.F)
    out += fmt::format(" --widen-valleys {}", options.operators.widen_valleys_m);
  return out;
}

}  // namespace

void add_generalize_options(CommandOptions& command, GeneralizeOptions& options) {
  command
      .add_option("IN", options.in,
                  "The DEM: GeoTIFF, ESRI ASCII, HGT …; grid and coordinates are kept")
      .required()
      .files(FileUse::input);
  command.add_option("OUT", options.out, "The result, altitudes in metres: .tif or .asc")
      .required()
      .files(FileUse::writes, raster_files);
  add_elevation_options(command, options.elevation);
  std::vector<std::string> names;
  for (const GeneralizePreset& preset : generalize_presets()) names.emplace_back(preset.name);
  command
      .add_option("--preset NAME", options.preset,
                  "Named weights and masks; options given with it override them")
      .one_of(names);
  add_weights(command, "--global", options.global,
              "Weights of the bands, the largest landforms first; their number is the number of "
              "bands. 1 keeps, 0 removes, more exaggerates (0 … 5)");
  add_weights(command, "--ridges", options.ridges,
              "Added along ridges: restores what --global removes, or sharpens (-5 … 5)");
  add_weights(command, "--valleys", options.valleys, "Added along valley lines (-5 … 5)");
  add_weights(command, "--background-global", options.background_global,
              "Weights far from the viewer. Default: as near");
  add_weights(command, "--background-ridges", options.background_ridges,
              "Added along ridges far from the viewer");
  add_weights(command, "--background-valleys", options.background_valleys,
              "Added along valley lines far from the viewer");
  command
      .add_option("--base W", options.bands.base,
                  "Weight of what is larger than all bands: raises or lowers the land as a whole, "
                  "by a share of its altitude")
      .show_default()
      .range(0.0, 5.0);
  const Option viewer = command
                            .add_option("--viewer E,N", options.viewer,
                                        "Position of the viewer, in the DEM's coordinates")
                            .list(',', 2);
  command
      .add_option("--distances NEAR,FAR", options.distances,
                  "Metres: only foreground up to the first, only background from the second")
      .list(',', 2)
      .needs(viewer);
  command
      .add_option("--mask FILE", options.mask,
                  "Raster mask: 0 unchanged, 1 (or 255) generalized; any grid and coordinates")
      .files(FileUse::input);
  command
      .add_option("--mask-slope FLAT,STEEP", options.mask_slope,
                  "Degrees: ground flatter than the first is unchanged, steeper than the second is "
                  "generalized")
      .list(',', 2);
  command.add_flag(
      "--automatic-mask", options.automatic_mask,
      "Applies no exaggeration to flat ground at the foot of slopes, where it would dig moats");
  command.add_flag("--change-lakes", options.change_lakes,
                   "Generalizes lakes like land; otherwise they keep their level");
  command
      .add_option(
          "--curvature bounded|plan", options.curvature,
          "Curvature that finds ridges: bounded is quiet in flats, plan also finds gentle ones")
      .show_default()
      .one_of({"bounded", "plan"});
  command
      .add_option("--full-curvature X", options.bands.full_curvature,
                  "Curvature times cell size of a full ridge; a smaller value makes more of the "
                  "ground a ridge. 0: 0.15 for bounded, 0.8 for plan")
      .range(0.0, 10.0);
  command
      .add_option("--blur CELLS", options.bands.blur_cells,
                  "Width of the transition between ridge and slope, in cells of each band")
      .show_default()
      .range(0.0, 10.0);
  command
      .add_option("--exponent X", options.bands.exponent,
                  "1: detail on ridges and valley lines only; towards 0 slopes keep theirs too")
      .show_default()
      .range(0.0, 4.0);
  add_terrain_operators(command, options.operators);
  command
      .add_option(
          "--report DIR", options.report,
          "Also writes a folder with a page of pictures and numbers: index.html, report.json")
      .files(FileUse::folder);
  add_run_options(command, options, "altitude");
  command.footer(
      "Bands halve in size from one weight to the next. The last holds landforms of 1 to 2 cells "
      "(30 to 60 m in a\n"
      "DEM of 30 m), the one before it 2 to 4, and so on.\n"
      "\n"
      "  belvedere generalize dem.tif smooth.tif --preset smooth_slopes\n"
      "  belvedere generalize dem.tif out.tif --global 1,1,0.7,0.3,0 --ridges 0,0,0.3,0.8,1.1\n"
      "  belvedere generalize dem.tif out.tif --preset panorama --viewer 692000,5302000 "
      "--distances 30000,90000\n"
      "  belvedere generalize dem.tif out.tif --global 1,1.5,2,1,0.5 --automatic-mask --hillshade "
      "relief.tif\n"
      "  belvedere generalize dem.tif out.tif --preset bold_ridges --report report\n"
      "\n"
      "Presets:\n" +
      preset_lines());
}

GeneralizeParameters resolve_bands(const GeneralizeOptions& options) {
  GeneralizeParameters bands = options.bands;
  const GeneralizePreset* preset =
      options.preset.empty() ? nullptr : find_generalize_preset(options.preset);
  if (preset == nullptr && options.global.empty()) {
    refuse("--global", "no weights",
           "--global 1,1,0.7,0.3,0 (the largest landforms first), or --preset NAME");
  }
  choose_weights(bands,
                 {.foreground = options.global,
                  .foreground_ridges = options.ridges,
                  .foreground_valleys = options.valleys,
                  .background = options.background_global,
                  .background_ridges = options.background_ridges,
                  .background_valleys = options.background_valleys},
                 preset);
  bands.curvature = options.curvature == "plan" ? CurvatureForm::plan : CurvatureForm::bounded;
  const std::size_t count = bands.foreground.size();
  if (count > 12) refuse("--global", fmt::format("{} weights", count), "1 to 12");
  check_set("--global", bands.foreground, count, 0.F);
  check_set("--background-global", bands.background, count, 0.F);
  check_set("--ridges", bands.foreground_ridges, count, -5.F);
  check_set("--valleys", bands.foreground_valleys, count, -5.F);
  check_set("--background-ridges", bands.background_ridges, count, -5.F);
  check_set("--background-valleys", bands.background_valleys, count, -5.F);
  const bool differs = bands.background != bands.foreground ||
                       bands.background_ridges != bands.foreground_ridges ||
                       bands.background_valleys != bands.foreground_valleys;
  if (differs && options.viewer.empty()) {
    refuse("--viewer",
           (options.preset.empty() ? std::string("the background") : options.preset) +
               " weights terrain by distance from the viewer",
           "--viewer E,N in the DEM's coordinates");
  }
  return bands;
}

std::optional<SlopeRange> masked_slopes(const GeneralizeOptions& options) {
  if (!options.mask_slope.empty()) return SlopeRange{options.mask_slope[0], options.mask_slope[1]};
  const GeneralizePreset* preset = find_generalize_preset(options.preset);
  return preset != nullptr ? preset->slope_mask : std::nullopt;
}

bool masks_slope_feet(const GeneralizeOptions& options) {
  const GeneralizePreset* preset = find_generalize_preset(options.preset);
  return options.automatic_mask || (preset != nullptr && preset->automatic_mask);
}

std::string describe_generalize(const GeneralizeOptions& options,
                                const GeneralizeParameters& bands) {
  std::string out =
      fmt::format("belvedere generalize {} {}", file_name(options.in), file_name(options.out));
  const auto set = [&out](const char* option, const Weights& weights) {
    if (!weights.empty()) out += fmt::format(" {} {}", option, fmt::join(weights, ","));
  };
  if (!options.elevation.encoding.empty()) out += " --encoding " + options.elevation.encoding;
  if (!options.elevation.variable.empty()) out += " --variable " + options.elevation.variable;
  if (!options.preset.empty()) out += " --preset " + options.preset;
  set("--global", bands.foreground);
  set("--ridges", bands.foreground_ridges);
  set("--valleys", bands.foreground_valleys);
  if (!options.viewer.empty()) {
    set("--background-global", bands.background);
    set("--background-ridges", bands.background_ridges);
    set("--background-valleys", bands.background_valleys);
    out += fmt::format(" --viewer {}", fmt::join(options.viewer, ","));
  }
  if (!options.distances.empty())
    out += fmt::format(" --distances {}", fmt::join(options.distances, ","));
  if (!options.mask.empty()) out += " --mask " + file_name(options.mask);
  if (!options.mask_slope.empty())
    out += fmt::format(" --mask-slope {}", fmt::join(options.mask_slope, ","));
  if (options.automatic_mask) out += " --automatic-mask";
  if (options.change_lakes) out += " --change-lakes";
  return out + describe_operators(options, bands);
}

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
                      const std::function<Grid<float>()>& read_drawn) {
  Grid<float> mask;
  if (const auto range = masked_slopes(options)) mask = slope_mask(dem.altitude_m, cell_m, *range);
  return combine_masks(std::move(mask), read_drawn());
}

}  // namespace

GeneralizedDem generalize_dem(const GeneralizeOptions& options, const GeneralizeParameters& bands,
                              Dem& dem, glm::dvec2 cell_m,
                              const std::function<Grid<float>()>& read_mask, Progress& progress) {
  const double cell = 0.5 * (cell_m.x + cell_m.y);
  // Destriping changes the data, and so the masks that are made from them.
  if (options.operators.destripe) dem.altitude_m = destripe(dem.altitude_m, {}, progress);
  GeneralizedDem out;
  GeneralizeGrids& grids = out.grids;
  // First, because it needs the most memory.
  if (masks_slope_feet(options))
    grids.amplification_mask = make_foot_mask(dem, cell_m, bands.foreground.size());
  if (!options.change_lakes) grids.keep = find_lakes(dem.altitude_m, {});
  grids.mask = make_mask(options, dem, cell_m, read_mask);
  grids.foreground_share = share_by_distance(options, dem, cell_m);
  Grid<float> plain_m;
  if (options.operators.line_integral)
    plain_m = generalize_along_slope_lines(dem.altitude_m, grids.mask, cell, {}, progress);
  out.altitude_m =
      generalize(plain_m.empty() ? dem.altitude_m : plain_m, cell_m, grids, bands, progress);
  plain_m = {};
  out.altitude_m = operate_after_bands(out.altitude_m, grids.keep, grids.mask, cell,
                                       options.operators, progress);
  return out;
}

namespace {

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

  const Grid<float> original_m = options.report.empty() ? Grid<float>() : dem.altitude_m;
  GeneralizedDem made = generalize_dem(
      options, bands, dem, cell_m, [&] { return drawn_mask(options, dem, progress); }, progress);
  Grid<float>& result_m = made.altitude_m;

  if (!options.report.empty()) {
    write_generalize_report(options.report,
                            {.title = file_name(options.in),
                             .command = describe_generalize(options, bands),
                             .before_m = original_m,
                             .after_m = result_m,
                             .cell_m = cell_m,
                             .grids = made.grids,
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
