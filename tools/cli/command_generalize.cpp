#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/json.h"
#include "base/parallel.h"
#include "renderer/image/image_io.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/cli/terrain_operators.h"
#include "tools/report/equalizer_page.h"
#include "tools/report/generalize_report_page.h"

namespace belvedere::tools {
namespace {

using Weights = std::vector<float>;

struct Options {
  std::string in;
  std::string out;
  std::string preset;
  Weights global, ridges, valleys;
  Weights background_global, background_ridges, background_valleys;
  std::string curvature = "bounded";
  GeneralizeParameters bands;
  std::vector<double> viewer;     // E, N
  std::vector<double> distances;  // near, far, m
  std::string mask;
  std::vector<double> mask_slope;
  bool automatic_mask = false;
  bool change_lakes = false;
  TerrainOperators operators;
  std::string report;
  std::string equalizer;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};

[[noreturn]] void refuse(const std::string& where, const std::string& found, const std::string& allowed) {
  throw Error(ErrorKind::usage, where, found, allowed);
}

void check_set(const char* option, const Weights& weights, std::size_t bands, float least) {
  if (weights.empty()) return;
  if (weights.size() != bands) {
    refuse(option, fmt::format("{} weights", weights.size()), fmt::format("as many as --global has, {}", bands));
  }
  for (const float w : weights)
    if (!(w >= least && w <= 5.F)) refuse(option, fmt::format("a weight of {}", w), fmt::format("{} … 5; 1 keeps a band", least));
}

// The weights asked for. A page with sliders begins with the terrain as it is.
GeneralizeParameters resolve_bands(const Options& options) {
  GeneralizeParameters bands = options.bands;
  const GeneralizePreset* preset = options.preset.empty() ? nullptr : find_generalize_preset(options.preset);
  if (preset == nullptr && options.global.empty() && options.equalizer.empty()) {
    refuse("--global", "no weights", "--global 1,1,0.7,0.3,0 (the largest landforms first), or --preset NAME");
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
  const bool differs = bands.background != bands.foreground || bands.background_ridges != bands.foreground_ridges ||
                       bands.background_valleys != bands.foreground_valleys;
  if (differs && options.viewer.empty() && !(options.out.empty() && !options.equalizer.empty())) {
    refuse("--viewer", "weights that differ near and far, and nobody who looks", "--viewer E,N in the DEM's coordinates");
  }
  return bands;
}

// Between which distances foreground turns into background: by default a quarter and three quarters of the way to the farthest corner.
glm::dvec2 blend_distances(const Options& options, const Dem& dem, glm::dvec2 viewer_cell, glm::dvec2 cell_m) {
  if (!options.distances.empty()) {
    const glm::dvec2 written(options.distances[0], options.distances[1]);
    if (!(written.x >= 0.0 && written.x < written.y)) {
      refuse("--distances", fmt::format("from {} to {} m", written.x, written.y), "two distances, the nearer first");
    }
    return written;
  }
  double farthest = 1.0;
  for (const double x : {0.0, dem.width() - 1.0}) {
    for (const double y : {0.0, dem.height() - 1.0})
      farthest = std::max(farthest, std::hypot((x - viewer_cell.x) * cell_m.x, (y - viewer_cell.y) * cell_m.y));
  }
  return {0.25 * farthest, 0.75 * farthest};
}

// 1 near, 0 far, smoothstep between the two distances.
Grid<float> share_by_distance(const Options& options, const Dem& dem, glm::dvec2 cell_m) {
  if (options.viewer.empty()) return {};
  const glm::dvec2 at = dem.transform.to_cell(options.viewer[0], options.viewer[1]);
  const auto distance_m = [&](double x, double y) { return std::hypot((x - at.x) * cell_m.x, (y - at.y) * cell_m.y); };
  const glm::dvec2 blend = blend_distances(options, dem, at, cell_m);
  const double near = blend.x;
  const double far = blend.y;
  Grid<float> share(dem.width(), dem.height());
  parallel_rows(dem.height(), [&](int y) {
    for (int x = 0; x < dem.width(); ++x) {
      const double t = std::clamp((distance_m(x, y) - near) / (far - near), 0.0, 1.0);
      share(x, y) = static_cast<float>(1.0 - t * t * (3.0 - 2.0 * t));
    }
  });
  return share;
}

// The slopes that are masked as asked for; nothing: none are.
std::optional<SlopeRange> masked_slopes(const Options& options) {
  if (!options.mask_slope.empty()) return SlopeRange{options.mask_slope[0], options.mask_slope[1]};
  const GeneralizePreset* preset = find_generalize_preset(options.preset);
  return preset != nullptr ? preset->slope_mask : std::nullopt;
}

bool masks_slope_feet(const Options& options) {
  const GeneralizePreset* preset = find_generalize_preset(options.preset);
  return options.automatic_mask || (preset != nullptr && preset->automatic_mask);
}

Grid<float> make_foot_mask(const Dem& dem, glm::dvec2 cell_m, std::size_t bands) {
  return slope_foot_mask(dem.altitude_m, cell_m, 1 << std::min<std::size_t>(bands, 6));
}

Grid<float> drawn_mask(const Options& options, const Dem& dem, Progress& progress) {
  if (options.mask.empty()) return {};
  RasterSource source;
  source.path = options.mask;
  return read_mask(source, {dem.transform, dem.width(), dem.height(), dem.crs}, progress);
}

Grid<float> make_mask(const Options& options, const Dem& dem, glm::dvec2 cell_m, Progress& progress) {
  Grid<float> mask;
  if (const auto range = masked_slopes(options)) mask = slope_mask(dem.altitude_m, cell_m, *range);
  return combine_masks(std::move(mask), drawn_mask(options, dem, progress));
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

// Before the work: what could not be written afterwards.
void check_place(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (ending != ".tif" && ending != ".tiff" && ending != ".asc") refuse(path, "is no name of a DEM the program writes", ".tif or .asc");
  check_output_folder(folder_of(path));
}

// The weights and masks as they would be typed, without folders: the same on every machine.
std::string describe_command(const Options& options, const GeneralizeParameters& bands) {
  const auto name = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
  std::string out = fmt::format("belvedere generalize {} {}", name(options.in), name(options.out));
  const auto set = [&out](const char* option, const Weights& weights) {
    if (!weights.empty()) out += fmt::format(" {} {}", option, fmt::join(weights, ","));
  };
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
  if (!options.distances.empty()) out += fmt::format(" --distances {}", fmt::join(options.distances, ","));
  if (!options.mask.empty()) out += " --mask " + name(options.mask);
  if (!options.mask_slope.empty()) out += fmt::format(" --mask-slope {}", fmt::join(options.mask_slope, ","));
  if (options.automatic_mask) out += " --automatic-mask";
  if (options.operators.destripe) out += " --destripe";
  if (options.operators.line_integral) out += " --line-integral";
  if (options.operators.widen_valleys_m > 0.F) out += fmt::format(" --widen-valleys {}", options.operators.widen_valleys_m);
  return out;
}

// The page with sliders. Without a viewer, one stands in the middle of the southern rim and looks north.
void write_equalizer(const Options& options, const Dem& dem, glm::dvec2 cell_m, const GeneralizeParameters& bands, Progress& progress) {
  const glm::dvec2 middle = dem.transform.to_crs(0.5 * (dem.width() - 1), dem.height() - 1.0);
  const glm::dvec2 viewer = options.viewer.empty() ? middle : glm::dvec2(options.viewer[0], options.viewer[1]);
  const glm::dvec2 viewer_cell = dem.transform.to_cell(viewer.x, viewer.y);
  glm::dvec2 distances_m = blend_distances(options, dem, viewer_cell, cell_m);
  if (options.distances.empty()) distances_m = {std::floor(distances_m.x), std::ceil(distances_m.y)};  // as people would type them
  const std::optional<SlopeRange> slopes = masked_slopes(options);
  const SlopeRange range = slopes.value_or(SlopeRange{});
  write_equalizer_page(options.equalizer,
                       {.title = std::filesystem::path(options.in).filename().string(),
                        .altitude_m = dem.altitude_m,
                        .cell_m = cell_m,
                        .start = bands,
                        .viewer_cell = viewer_cell,
                        .distances_m = distances_m,
                        .viewer_options = fmt::format("--viewer {},{} --distances {},{}", viewer.x, viewer.y, distances_m.x, distances_m.y),
                        .lakes = find_lakes(dem.altitude_m, {}),
                        .foot_mask = make_foot_mask(dem, cell_m, bands.foreground.size()),
                        .slope_mask = slope_mask(dem.altitude_m, cell_m, range),
                        .drawn_mask = drawn_mask(options, dem, progress),
                        .slope_range = range,
                        .drawn_name = std::filesystem::path(options.mask).filename().string(),
                        .switches = {.lakes = !options.change_lakes,
                                     .foot = masks_slope_feet(options),
                                     .slope = slopes.has_value(),
                                     .drawn = !options.mask.empty()}},
                       progress);
}

int run(const Options& options) {
  const bool only_page = options.out.empty() && !options.equalizer.empty();
  const GeneralizeParameters bands = resolve_bands(options);
  if (options.out.empty() && !only_page) refuse("OUT", "no file for the result", "a .tif or .asc; only --equalizer goes without");
  if (only_page && !options.report.empty()) refuse("--report", "no result to report on", "a file OUT beside it");
  if (!only_page) check_place(options.out);
  if (!options.equalizer.empty()) check_output_folder(folder_of(options.equalizer));
  if (!options.report.empty()) check_output_folder(options.report);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  progress.begin("reading", 0.0);
  RasterSource source;
  source.path = options.in;
  const std::optional<double> nodata = read_raster_info(source).nodata;  // voids stay what they are called
  Dem dem = make_dem(read_raster(source));
  const glm::dvec2 cell_m = ground_cell_m(dem.transform, dem.crs, dem.width(), dem.height());
  const bool true_cells = cell_m == glm::dvec2(dem.transform.cell_x, dem.transform.cell_y);
  if (!true_cells) {
    progress.note(fmt::format("a cell is {:.1f} × {:.1f} m on the ground in the middle of the DEM", cell_m.x, cell_m.y));
    const bool wants_metres = options.operators.line_integral || options.operators.widen_valleys_m > 0.F ||
                              !options.operators.hillshade.empty() || !options.operators.contours.empty();
    if (wants_metres) {
      refuse(options.in, "its cells are not in metres, which slope lines, valleys, shaded relief and contours need",
             "a DEM in a metric coordinate system (gdalwarp -t_srs EPSG:326xx); the weights of bands alone work on any");
    }
  }
  if (dem.crs.empty()) progress.note("the DEM names no coordinate system: its cells are taken for metres");

  if (!options.equalizer.empty()) write_equalizer(options, dem, cell_m, bands, progress);
  if (only_page) {
    progress.end();
    return 0;
  }
  const double cell = 0.5 * (cell_m.x + cell_m.y);
  const Grid<float> original_m = options.report.empty() ? Grid<float>() : dem.altitude_m;
  dem.altitude_m = operate_before_bands(std::move(dem.altitude_m), cell, options.operators, progress);
  GeneralizeGrids grids;
  // First, as it takes most memory on its way.
  if (masks_slope_feet(options)) grids.amplification_mask = make_foot_mask(dem, cell_m, bands.foreground.size());
  if (!options.change_lakes) grids.keep = find_lakes(dem.altitude_m, {});
  grids.mask = make_mask(options, dem, cell_m, progress);
  grids.foreground_share = share_by_distance(options, dem, cell_m);
  Grid<float> result_m = generalize(dem.altitude_m, cell_m, grids, bands, progress);
  result_m = operate_after_bands(result_m, grids.keep, cell, options.operators, progress);

  if (!options.report.empty()) {
    write_generalize_report(options.report,
                            {.title = std::filesystem::path(options.in).filename().string(),
                             .command = describe_command(options, bands),
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
      result_m[i] = std::numeric_limits<float>::quiet_NaN();  // a void stays one
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
  progress.note(fmt::format("altitudes change by {:.1f} m (root mean square), at most {:.1f} m", mean, largest));
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

std::string preset_lines() {
  std::string out;
  for (const GeneralizePreset& preset : generalize_presets()) out += fmt::format("  {:<14} {}\n", preset.name, preset.meaning);
  return out;
}

CLI::Option* add_weights(CLI::App& command, const char* name, Weights& weights, const char* meaning) {
  return command.add_option(name, weights, meaning)->type_name("W1,…,WN")->delimiter(',');
}

}  // namespace

Command add_generalize(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("generalize", "Simplifies a DEM for a map: weights landforms by their size, keeps ridges sharp");
  const auto options = std::make_shared<Options>();
  command->add_option("IN", options->in, "The DEM: GeoTIFF, ESRI ASCII, HGT …; it stays in its own grid and coordinates")->required();
  command->add_option("OUT", options->out, "The result, altitudes in metres: .tif or .asc. May be left out beside --equalizer");
  std::vector<std::string> names;
  for (const GeneralizePreset& preset : generalize_presets()) names.emplace_back(preset.name);
  command->add_option("--preset", options->preset, "Weights and masks by name; options beside it have the last word")
      ->type_name("NAME")
      ->check(CLI::IsMember(names));
  add_weights(*command, "--global", options->global,
              "Weights of the bands, the largest landforms first; as many bands as weights. 1 keeps, 0 removes, more exaggerates (0 … 5)");
  add_weights(*command, "--ridges", options->ridges, "Added along ridges: gives them back what --global takes, or more (-5 … 5)");
  add_weights(*command, "--valleys", options->valleys, "Added along valley lines (-5 … 5)");
  add_weights(*command, "--background-global", options->background_global, "Weights far from the viewer; else as near");
  add_weights(*command, "--background-ridges", options->background_ridges, "Added along ridges far from the viewer");
  add_weights(*command, "--background-valleys", options->background_valleys, "Added along valley lines far from the viewer");
  command->add_option("--viewer", options->viewer, "Where the viewer stands, in the DEM's coordinates")
      ->type_name("E,N")
      ->delimiter(',')
      ->expected(2);
  command->add_option("--distances", options->distances, "Metres: all foreground up to the first, all background from the second")
      ->type_name("NEAR,FAR")
      ->delimiter(',')
      ->expected(2)
      ->needs("--viewer");
  command->add_option("--mask", options->mask, "Raster: 0 stays as it is, 1 (or 255) is generalized; any grid and coordinates")
      ->type_name("FILE");
  command->add_option("--mask-slope", options->mask_slope, "Degrees: flatter than the first stays, steeper than the second is generalized")
      ->type_name("FLAT,STEEP")
      ->delimiter(',')
      ->expected(2);
  command->add_flag("--automatic-mask", options->automatic_mask,
                    "Exaggerates nothing on flat ground at the foot of slopes, where moats would be dug");
  command->add_flag("--change-lakes", options->change_lakes, "Lakes are generalized like land; otherwise they keep their level");
  command->add_option("--curvature", options->curvature, "How ridges are found: bounded is quiet in flats, plan finds gentle ones too")
      ->type_name("bounded|plan")
      ->capture_default_str()
      ->check(CLI::IsMember({"bounded", "plan"}));
  command
      ->add_option("--full-curvature", options->bands.full_curvature,
                   "Curvature times cell of a full ridge; less makes more of the ground a ridge. 0: .15 bounded, .8 plan")
      ->type_name("X")
      ->check(CLI::Range(0.0, 10.0));
  command->add_option("--blur", options->bands.blur_cells, "Softens the edge between ridge and slope, in cells of each band")
      ->type_name("CELLS")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 10.0));
  command->add_option("--exponent", options->bands.exponent, "1: detail on ridges and valley lines only; towards 0 slopes keep theirs too")
      ->type_name("X")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 4.0));
  add_terrain_operators(*command, options->operators);
  command
      ->add_option(
          "--equalizer", options->equalizer,
          "Also an .html page with sliders for all weights and a preview that follows them; its bands are those of --global, else six")
      ->type_name("FILE");
  command->add_option("--report", options->report, "Also a folder with a page of pictures and numbers: index.html, report.json")
      ->type_name("DIR");
  command->add_option("--threads", options->threads, "Processor threads; 0, the default, takes all. Changes no altitude")
      ->type_name("N")
      ->check(CLI::Range(0, 4096));
  command->add_flag("--quiet,-q", options->quiet, "No progress, no notes");
  command->add_flag("--json", options->json, "What was done as JSON on standard output");
  command->footer(
      "Bands halve in size from one weight to the next. The last holds landforms of 1 to 2 cells (30 to 60 m in a\n"
      "DEM of 30 m), the one before it 2 to 4, and so on.\n\n"
      "  belvedere generalize dem.tif smooth.tif --preset smooth_slopes\n"
      "  belvedere generalize dem.tif out.tif --global 1,1,0.7,0.3,0 --ridges 0,0,0.3,0.8,1.1\n"
      "  belvedere generalize dem.tif out.tif --preset panorama --viewer 692000,5302000 --distances 30000,90000\n"
      "  belvedere generalize dem.tif out.tif --global 1,1.5,2,1,0.5 --automatic-mask --hillshade relief.tif\n"
      "  belvedere generalize dem.tif out.tif --preset bold_ridges --report report\n"
      "  belvedere generalize dem.tif --equalizer sliders.html\n\n"
      "Presets:\n" +
      preset_lines());
  return {command, [options] { return run(*options); }};
}

}  // namespace belvedere::tools
