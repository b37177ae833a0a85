#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/json.h"
#include "base/parallel.h"
#include "renderer/image/image_io.h"
#include "renderer/image/output_file.h"
#include "terrain/climate/stations.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/io/raster_io.h"
#include "terrain/layers/fit/ground_fit.h"
#include "terrain/layers/fit/picture_classes.h"
#include "terrain/layers/layers_file.h"
#include "tools/cli/commands.h"
#include "tools/cli/file_names.h"
#include "tools/cli/layers/ground_climate_options.h"
#include "tools/cli/terminal.h"
#include "tools/report/layers_fit_page.h"

namespace belvedere::tools {
namespace {

struct Options {
  std::string dem, image, classes, legend, out, mask, regions, report;
  GroundClimateOptions climate;
  std::string functions = "fitted";
  std::string model = "product";
  std::vector<std::string> inputs;
  int classes_band = 1;
  int children = 4;
  int threads = 0;
  bool quiet = false;
};

// What was found on the way, for the terminal and for the report.
struct Findings {
  std::vector<std::string> notes;
  template <class... Args>
  void note(fmt::format_string<Args...> text, Args&&... args) {
    notes.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
};

[[noreturn]] void refuse(const std::string& where, const std::string& found, const std::string& allowed) {
  throw Error(ErrorKind::usage, where, found, allowed);
}

RasterSource source_of(const std::string& path, int band = 1) {
  RasterSource source;
  source.path = path;
  source.band = band;
  return source;
}

void check_options(const Options& options) {
  if (options.image.empty() == options.classes.empty())
    refuse("layers fit", "what covers the ground is said by nothing or by two", "--image, or --classes with --legend");
  if (!options.classes.empty() && options.legend.empty())
    refuse("--classes", "no --legend says what its codes mean", "esa_worldcover, corine, nlcd, fbfm40 or a file (docs/legends.md)");
  if (!options.regions.empty() && options.image.empty())
    refuse("--regions", "divides the colours of a picture, and there is none", "--image");
  if (options.functions != "fitted" && options.functions != "histogram") refuse("--functions", options.functions, "fitted, histogram");
  if (options.model != "product" && options.model != "additive") refuse("--model", options.model, "product, additive");
  if (options.functions == "histogram" && options.model != "product")
    refuse("--functions", "histograms are functions of a product", "--model product");
  if (options.children < 1 || options.children > 12) refuse("--children", fmt::format("{}", options.children), "1…12");
  std::set<std::string> read = {options.dem, options.image, options.classes, options.mask, options.regions, options.climate.stations};
  if (read.contains(options.out)) refuse(options.out, "is read as well", "another name for the result");
  if (!options.out.ends_with(".toml")) refuse(options.out, "is no name of a layers file", "NAME.layers.toml");
  check_place(options.out);
}

// Pictures that say where on Earth they lie.
bool has_geography(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".tif" || ending == ".tiff" || ending == ".img" || ending == ".vrt";
}

struct Ground {
  Dem dem;
  Grid<std::uint8_t> use;  // 0: void, masked, outside the picture
  std::optional<RgbPlanes> rgb;
};

RasterFrame frame_of(const Dem& dem) { return {dem.transform, dem.width(), dem.height(), dem.crs}; }

RgbPlanes planes_of(const Grid<glm::vec3>& picture) {
  RgbPlanes planes{Grid<float>(picture.width(), picture.height()), Grid<float>(picture.width(), picture.height()),
                   Grid<float>(picture.width(), picture.height())};
  for (std::size_t i = 0; i != picture.size(); ++i) {
    planes.r[i] = 255.0F * picture[i].x;
    planes.g[i] = 255.0F * picture[i].y;
    planes.b[i] = 255.0F * picture[i].z;
  }
  return planes;
}

// A picture without coordinates lies on the DEM's cells, one pixel a cell; one that has them brings the DEM onto its own.
Ground read_picture_ground(const Options& options, Findings& findings, Progress& progress) {
  Ground ground;
  if (!has_geography(options.image)) {
    ground.dem = read_layer_dem(options.dem, progress);
    const Grid<glm::vec3> picture = read_picture(options.image);
    if (picture.width() != ground.dem.width() || picture.height() != ground.dem.height())
      throw Error(ErrorKind::input, options.image,
                  fmt::format("{}×{} pixels, and {} has {}×{} cells; the picture does not say where it lies", picture.width(),
                              picture.height(), file_name(options.dem), ground.dem.width(), ground.dem.height()),
                  "one pixel for each cell, or a GeoTIFF with coordinates");
    findings.note("the picture has no coordinates and lies on the cells of the DEM");
    ground.rgb = planes_of(picture);
  } else {
    const RasterInfo info = read_raster_info(source_of(options.image));
    if (info.bands < 3)
      throw Error(ErrorKind::input, options.image, fmt::format("{} band{}", info.bands, info.bands == 1 ? "" : "s"), "red, green and blue");
    RasterFrame frame{info.transform, info.width, info.height, info.crs};
    if (info.crs.empty()) refuse(options.image, "no coordinate system", "a GeoTIFF that has one");
    if (info.geographic || !crs_traits(info.crs).metric) frame = choose_frame({source_of(options.image)}, "", 0.0, std::nullopt);
    const auto band = [&](int number) {
      RasterSource source = source_of(options.image, number);
      source.unit_to_m = 1.0;  // no altitudes
      return warp_rasters({source}, frame, progress).cells;
    };
    ground.rgb = RgbPlanes{band(1), band(2), band(3)};
    Raster<float> altitude = warp_rasters({source_of(options.dem)}, frame, progress);
    const RasterInfo dem = read_raster_info(source_of(options.dem));
    if (std::none_of(altitude.cells.begin(), altitude.cells.end(), [](float z) { return std::isfinite(z); }))
      throw Error(ErrorKind::input, options.image, fmt::format("does not overlap {}", file_name(options.dem)),
                  "a picture of the DEM's ground");
    if (dem.width != frame.width || dem.height != frame.height || !(dem.transform == frame.transform))
      findings.note("the DEM ({}×{} cells) was resampled to the picture's {}×{} cells", dem.width, dem.height, frame.width, frame.height);
    ground.dem = make_dem(std::move(altitude));
  }
  ground.use = Grid<std::uint8_t>(ground.dem.width(), ground.dem.height());
  float most = 0.0F;
  for (std::size_t i = 0; i != ground.use.size(); ++i) {
    const bool known = std::isfinite(ground.rgb->r[i]) && std::isfinite(ground.rgb->g[i]) && std::isfinite(ground.rgb->b[i]);
    ground.use[i] = known && ground.dem.filled[i] == 0 ? 1 : 0;
    if (!known) ground.rgb->r[i] = ground.rgb->g[i] = ground.rgb->b[i] = 0.0F;
    most = std::max({most, ground.rgb->r[i], ground.rgb->g[i], ground.rgb->b[i]});
  }
  if (most > 255.0F)
    throw Error(ErrorKind::input, options.image, fmt::format("values up to {}", most), "8 bits, 0…255, as a picture is shown");
  return ground;
}

// Cells that somebody marked are left out: fields, whose place no ground explains.
void leave_out_masked(const Options& options, Ground& ground, Findings& findings, Progress& progress) {
  if (options.mask.empty()) return;
  const Raster<std::int32_t> mask = warp_codes({source_of(options.mask)}, frame_of(ground.dem), progress);
  std::size_t left_out = 0;
  for (std::size_t i = 0; i != ground.use.size(); ++i) {
    if (mask.cells[i] <= 0) continue;
    ground.use[i] = 0;
    ++left_out;
  }
  findings.note("{:.1f} % of the cells are masked", 100.0 * static_cast<double>(left_out) / static_cast<double>(ground.use.size()));
}

void classes_of_picture(const Options& options, const Ground& ground, KnownGround& known, Findings& findings) {
  PictureClassParameters parameters;
  if (!options.regions.empty())
    parameters.regions = read_colour_regions(options.regions, [](const std::string& path) { return read_picture(path); });
  PictureClasses found = picture_classes(*ground.rgb, known.altitude_m, known.cell_m, ground.use, parameters);
  const auto share = [](const Grid<std::uint8_t>& mask) {
    std::size_t set = 0;
    for (const std::uint8_t m : mask) set += m;
    return 100.0 * static_cast<double>(set) / static_cast<double>(mask.size());
  };
  if (found.clouds.found)
    findings.note("clouds cover {:.1f} %, their shadows {:.1f} %, {} cells {} and {} {} of them: the sun stands at azimuth {:.0f}°",
                  share(found.clouds.cloud), share(found.clouds.shadow), std::abs(found.clouds.shadow_x),
                  found.clouds.shadow_x < 0 ? "west" : "east", std::abs(found.clouds.shadow_y),
                  found.clouds.shadow_y < 0 ? "north" : "south", found.clouds.sun_azimuth_deg);
  else
    findings.note("no clouds: nothing white has a shadow beside it");
  if (!parameters.regions.empty())
    findings.note("{} classes by {} regions drawn", found.classes.size(), parameters.regions.size());
  else if (found.lightness)
    findings.note("{} classes by lightness: nearly all has one hue", found.classes.size());
  else
    findings.note("{} classes by hue and saturation, of {} parts of a mixture", found.classes.size(), found.parts);
  findings.note("{:.1f} % of the ground in use is grey", 100.0 * found.grey_share);
  known.classes = std::move(found.classes);
  known.labels = std::move(found.labels);
  known.picture = FitPicture{*ground.rgb, found.clouds.found ? std::optional<double>(found.clouds.sun_azimuth_deg) : std::nullopt};
}

void classes_of_map(const Options& options, const Ground& ground, KnownGround& known, Findings& findings, Progress& progress) {
  const Legend legend = read_legend(options.legend);
  const Raster<std::int32_t> codes = warp_codes({source_of(options.classes, options.classes_band)}, frame_of(ground.dem), progress);
  known.labels.assign(ground.use.size(), no_class);
  std::array<int, 256> number{};
  number.fill(-1);
  std::map<std::int32_t, std::size_t> unknown;
  std::size_t overlapping = 0;
  for (std::size_t i = 0; i != known.labels.size(); ++i) {
    const std::int32_t code = codes.cells[i];
    if (code >= 0) ++overlapping;
    if (ground.use[i] == 0 || code < 0 || legend.nodata.contains(code)) continue;
    const auto entry = legend.entries.find(code);
    if (entry == legend.entries.end()) {
      ++unknown[code];
      continue;
    }
    const LandCoverClass painted_as = entry->second.painted_as;
    int& k = number[static_cast<std::size_t>(painted_as)];
    if (k < 0) {
      k = static_cast<int>(known.classes.size());
      const auto info = std::find_if(land_cover_table.begin(), land_cover_table.end(),
                                     [&](const LandCoverClassInfo& row) { return row.id == painted_as; });
      known.classes.push_back({std::string(info->name), painted_as, info->rgb});
    }
    known.labels[i] = static_cast<std::uint8_t>(k);
  }
  if (overlapping == 0)
    throw Error(ErrorKind::input, options.classes, fmt::format("does not overlap {}", file_name(options.dem)),
                "land cover of the DEM's ground");
  const RasterInfo info = read_raster_info(source_of(options.classes));
  if (info.width != ground.dem.width() || info.height != ground.dem.height())
    findings.note("the classes ({}×{} cells) were resampled to the DEM's {}×{} cells", info.width, info.height, ground.dem.width(),
                  ground.dem.height());
  for (const auto& [code, cells] : unknown) findings.note("code {} ({} cells) is not in the legend and left out", code, cells);
}

std::vector<std::string> inputs_of(const Options& options, const Dem& dem) {
  if (!options.inputs.empty()) {
    for (const std::string& name : options.inputs) require_layer_input(name, "--inputs");
    return options.inputs;
  }
  std::vector<std::string> names = {"altitude", "slope"};
  // What somebody measured; the climate that is computed follows from altitude and adds nothing within one region.
  StationTable stations;
  if (!options.climate.stations.empty()) stations = read_stations(options.climate.stations, dem.crs, silent_progress());
  if (!options.climate.files.temperature.empty() || stations.has_temperature()) names.emplace_back("temperature");
  if (!options.climate.files.rain.empty() || stations.has_rain()) names.emplace_back("rain");
  names.emplace_back("radiation");
  if (options.model == "product") {
    // A product of functions up to 1 can only veto: more inputs gain nothing there.
    names.insert(names.end(), {"north", "east"});
    if (names.size() > 5) names.resize(5);
    return names;
  }
  names.insert(names.end(),
               {"north", "east", "relief_180", "relief_750", "relief_1800", "relief_4000", "above_valley", "log_catchment", "sky_view"});
  // Lakes are flat; in pictures they are what is dark and blue.
  if (!options.classes.empty()) names.insert(names.end(), {"flatness", "roughness"});
  return names;
}

// White everywhere, and no slope is lighter than another: that is cloud. Snow has the sun on its slopes.
void refuse_cloud(const Options& options, const KnownGround& known, const GroundFit& fit) {
  constexpr double nearly_all = 0.95;
  constexpr double least_correlation = 0.1;
  constexpr float white = 0.6F * 255.F;
  constexpr float palest = 0.25F;  // of saturation
  const RgbPlanes& rgb = known.picture->rgb;
  std::size_t whites = 0;
  std::size_t all = 0;
  for (std::size_t i = 0; i != known.labels.size(); ++i) {
    if (known.labels[i] == no_class) continue;
    const float most = std::max({rgb.r[i], rgb.g[i], rgb.b[i]});
    const float least = std::min({rgb.r[i], rgb.g[i], rgb.b[i]});
    whites += most > white && most - least < palest * most ? 1U : 0U;
    ++all;
  }
  const double share = static_cast<double>(whites) / static_cast<double>(std::max<std::size_t>(all, 1));
  if (share < nearly_all || fit.sun.correlation > least_correlation) return;
  throw Error(ErrorKind::input, options.image,
              fmt::format("{:.0f} % of it is white, and no slope is lighter than another: cloud everywhere", 100.0 * share),
              "a picture that shows the ground");
}

void note_fit(const KnownGround& known, const GroundFit& fit, Findings& findings) {
  if (known.picture)
    findings.note("sun found at azimuth {:.0f}°, {:.0f}° high: its light and the picture's correlate by {:.2f}", fit.sun.azimuth_deg,
                  fit.sun.elevation_deg, fit.sun.correlation);
  const std::vector<std::size_t> counts = count_labels(known.labels, static_cast<int>(known.classes.size()));
  std::size_t total = 0;
  for (const std::size_t c : counts) total += c;
  const std::vector<double> predicted = mean_shares(predict_ground(known, fit).classes, known.labels);
  for (const int k_int : fit.classes.order) {
    const auto k = static_cast<std::size_t>(k_int);
    findings.note("{}: {:.1f} % of the ground, {:.1f} % as fitted, {} colours", known.classes[k].name,
                  100.0 * static_cast<double>(counts[k]) / static_cast<double>(total), 100.0 * predicted[k],
                  std::count(fit.parent.begin(), fit.parent.end(), k_int));
  }
  if (fit.classes.saturated > 0)
    findings.note("{} of {} functions are saturated: their classes occur in less than half of the range, where a mean of 1/2 cannot be",
                  fit.classes.saturated, known.classes.size() * fit.ranges.size());
}

int run(const Options& options) {
  check_options(options);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  Findings findings;
  Ground ground;
  if (!options.image.empty()) {
    ground = read_picture_ground(options, findings, progress);
  } else {
    ground.dem = read_layer_dem(options.dem, progress);
    ground.use = Grid<std::uint8_t>(ground.dem.width(), ground.dem.height());
    for (std::size_t i = 0; i != ground.use.size(); ++i) ground.use[i] = ground.dem.filled[i] == 0 ? 1 : 0;
  }
  leave_out_masked(options, ground, findings, progress);
  KnownGround known;
  known.cell_m = ground.dem.cell_m();
  known.altitude_m = ground.dem.altitude_m;
  progress.begin("finding classes", 0.0);
  if (!options.image.empty())
    classes_of_picture(options, ground, known, findings);
  else
    classes_of_map(options, ground, known, findings, progress);
  known.input_names = inputs_of(options, ground.dem);
  const LayerClimateGrids climate = climate_of(options.climate, ground.dem, known.input_names, progress);
  for (const std::string& source : climate.sources) findings.note("{}", source);
  known.inputs = layer_inputs(make_layer_ground(ground.dem, climate.view(), known.input_names));
  progress.begin("fitting functions", 0.0);
  GroundFitParameters parameters;
  parameters.model = options.model == "product" ? LayerModel::product : LayerModel::additive;
  parameters.functions = options.functions == "fitted" ? FunctionSource::fitted : FunctionSource::histogram;
  parameters.children = options.children;
  const GroundFit fit = fit_ground(known, parameters);
  if (known.picture) refuse_cloud(options, known, fit);
  note_fit(known, fit, findings);
  const std::string name = file_name(options.out).substr(0, file_name(options.out).find('.'));
  const SurfaceLayers layers = surface_layers_of(known, fit, name);
  const std::string text = surface_layers_text(layers);
  if (!options.report.empty())
    write_layers_fit_report(
        options.report,
        {.title = fmt::format("{} from {}", file_name(options.out), file_name(options.image.empty() ? options.classes : options.image)),
         .command = fmt::format("belvedere layers fit --dem {} {} --out {} --report {}", file_name(options.dem),
                                options.image.empty()
                                    ? fmt::format("--classes {} --legend {}", file_name(options.classes), file_name(options.legend))
                                    : fmt::format("--image {}", file_name(options.image)),
                                file_name(options.out), file_name(options.report)),
         .notes = findings.notes,
         .ground = &known,
         .fit = &fit,
         .parameters = parameters,
         .layers = layers},
        progress);
  write_text_file(options.out, text);
  progress.end();
  if (!options.quiet) {
    print_out(fmt::format("{}: {} layers, {:.1f} KB\n", options.out, layers.layers.size(), static_cast<double>(text.size()) / 1000.0));
    for (const std::string& note : findings.notes) print_out("  " + note + "\n");
  }
  return 0;
}

}  // namespace

Action add_layers_fit(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("--dem", options->dem, "The ground: a DEM")->required()->type_name("FILE");
  command
      .add_option(
          "--image", options->image,
          "A satellite picture of it: a GeoTIFF (the DEM is brought onto its cells), or PNG or JPEG with a pixel for each cell of the DEM")
      ->type_name("FILE");
  command.add_option("--classes", options->classes, "Instead of a picture: a land-cover raster")->type_name("FILE");
  command.add_option("--classes-band", options->classes_band, "Which band of it; default 1")->type_name("N")->check(CLI::PositiveNumber);
  command.add_option("--legend", options->legend, "What its codes mean: a legend's name or file (docs/legends.md)")->type_name("NAME");
  command.add_option("--out", options->out, "The layers: a .toml file of some ten KB, which needs the picture no more")
      ->required()
      ->type_name("TOML");
  add_ground_climate(command, options->climate);
  command.add_option("--mask", options->mask, "Cells above 0 are not learned from: fields, towns")->type_name("FILE");
  command
      .add_option("--regions", options->regions,
                  "Which colours of the picture are one class, drawn by hand: a .toml file (docs/layers_fit.md)")
      ->type_name("FILE");
  command
      .add_option("--functions", options->functions,
                  "How functions are found: fitted by likelihood (the default), or histogram, as first published")
      ->type_name("HOW");
  command
      .add_option("--model", options->model,
                  "product (the default): coverage is the product of functions; additive: shares by their sum, finer, larger")
      ->type_name("NAME");
  command
      .add_option("--inputs", options->inputs, "What functions are of, instead of what suits the model: altitude,slope,… (docs/layers.md)")
      ->delimiter(',')
      ->type_name("NAMES");
  command.add_option("--children", options->children, "Colours of a class, 1…12; default 4")->type_name("N");
  command
      .add_option("--report", options->report, "A folder for a page on what was learned and how it does on ground not seen; takes a minute")
      ->type_name("DIR");
  command.add_option("--threads", options->threads, "Processor threads; 0, the default, takes all. Changes no bit")->type_name("N");
  command.add_flag("-q,--quiet", options->quiet, "Print nothing but errors");
  command.footer(
      "Finds clouds and their shadows, the sun and the classes of colours in the picture, and how each hangs on altitude, slope, sun …\n\n"
      "  belvedere layers fit --dem ararat.tif --image autumn.tif --out ararat.layers.toml --report ararat_report");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
