#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/layers/fit/fit_texture.h"
#include "terrain/layers/fit/ground_fit.h"
#include "terrain/layers/fit/textured_layers.h"
#include "terrain/layers/layers_file.h"
#include "tools/cli/commands.h"
#include "tools/cli/layers/fit_sources.h"
#include "tools/cli/layers/ground_climate_options.h"
#include "tools/cli/terminal.h"
#include "tools/cli/terrain_operators.h"
#include "tools/options/options.h"
#include "tools/report/layers_fit_page.h"

namespace belvedere::tools {
namespace {

struct LayersFitOptions {
  FitSources from;
  std::string out, report;
  GroundClimateOptions climate;
  std::string functions = "fitted";
  std::string model = "product";
  std::optional<double> smoothing, roughness;
  std::vector<std::string> inputs;
  int threads = 0;
  bool quiet = false;
};

void check_options(const LayersFitOptions& options) {
  if (options.from.image.empty() == options.from.classes.empty())
    refuse("layers fit", "give either a picture or a map of classes",
           "--image, or --classes with --legend");
  if (!options.from.classes.empty() && options.from.legend.empty())
    refuse("--classes", "--legend is missing, which gives the classes of the codes",
           "esa_worldcover, corine, nlcd, fbfm40 or a file (docs/legends.md)");
  if (!options.from.regions.empty() && options.from.image.empty())
    refuse("--regions", "divides the colours of a picture, but none is given", "--image");
  if (options.from.image.empty() && (!options.from.bands.empty() || options.from.haze ||
                                     options.from.grey_hue_deg || options.from.snow_from_m))
    refuse("--bands, --haze, --grey-hue and --snow-from", "are of a picture, but none is given",
           "--image");
  if (options.functions != "fitted" && options.functions != "histogram")
    refuse("--functions", options.functions, "fitted, histogram");
  if (options.model != "product" && options.model != "additive")
    refuse("--model", options.model, "product, additive");
  if (options.functions == "histogram" && options.model != "product")
    refuse("--functions", "histograms are functions of a product", "--model product");
  if (options.smoothing && (options.functions != "histogram" || !(*options.smoothing >= 0.0)))
    refuse("--smoothing", fmt::format("{:g}", *options.smoothing),
           "0 or more samples, with --functions histogram");
  if (options.roughness && (options.functions != "fitted" || !(*options.roughness >= 0.0)))
    refuse("--roughness", fmt::format("{:g}", *options.roughness),
           "0 or more, with --functions fitted");
  if (!options.from.bands.empty() &&
      (options.from.bands.size() < 3 || options.from.bands.size() > 4 ||
       *std::min_element(options.from.bands.begin(), options.from.bands.end()) < 1))
    refuse("--bands", fmt::format("{} bands", options.from.bands.size()),
           "numbers from 1: RED,GREEN,BLUE or RED,GREEN,BLUE,INFRARED");
  if (!options.out.ends_with(".toml"))
    refuse(options.out, "is not the name of a layers file", "NAME.layers.toml");
  if (!options.from.legend.empty()) read_legend(options.from.legend);  // refuses what is none
}

std::vector<std::string> inputs_of(const LayersFitOptions& options) {
  if (!options.inputs.empty()) {
    for (const std::string& name : options.inputs) require_layer_input(name, "--inputs");
    return options.inputs;
  }
  // The climate lets a file travel to other altitudes and latitudes.
  std::vector<std::string> names = {"altitude", "slope", "temperature", "rain", "radiation"};
  // A product of functions up to 1 can only lower coverage: more inputs gain nothing there.
  if (options.model == "product") return names;
  names.insert(names.end(), {"north", "east", "relief_180", "relief_750", "relief_1800",
                             "relief_4000", "above_valley", "log_catchment", "sky_view"});
  // Lakes are flat; in pictures they are dark and blue.
  if (!options.from.classes.empty()) names.insert(names.end(), {"flatness", "roughness"});
  return names;
}

// White everywhere, with no slope lighter than another, is cloud. Snow is lighter on sunny slopes.
void refuse_cloud(const LayersFitOptions& options, const KnownGround& known, const GroundFit& fit) {
  constexpr double nearly_all = 0.95;
  constexpr double min_correlation = 0.1;
  constexpr float white = 0.6F * 255.F;
  constexpr float palest = 0.25F;  // of saturation
  std::size_t whites = 0;
  std::size_t all = 0;
  for (std::size_t i = 0; i != known.labels.size(); ++i) {
    if (known.labels[i] == no_class) continue;
    const glm::vec3& rgb = known.picture->rgb[i];
    const float max = std::max({rgb.x, rgb.y, rgb.z});
    const float min = std::min({rgb.x, rgb.y, rgb.z});
    whites += max > white && max - min < palest * max ? 1U : 0U;
    ++all;
  }
  const double share =
      static_cast<double>(whites) / static_cast<double>(std::max<std::size_t>(all, 1));
  if (share < nearly_all || fit.sun.correlation > min_correlation) return;
  throw Error(
      ErrorKind::input, options.from.image,
      fmt::format("{:.0f} % of it is white, with no slope lighter than another: cloud everywhere",
                  100.0 * share),
      "a picture that shows the ground");
}

void note_fit(const KnownGround& known, const GroundFit& fit, const GroundPrediction& prediction,
              const std::vector<ClassTexture>& textures, FitFindings& findings) {
  if (known.picture)
    findings.note(
        fmt::format("sun estimated at azimuth {:.0f}°, {:.0f}° high: its light and the picture "
                    "correlate by {:.2f}",
                    fit.sun.azimuth_deg, fit.sun.elevation_deg, fit.sun.correlation));
  const std::vector<std::size_t> counts =
      count_labels(known.labels, static_cast<int>(known.classes.size()));
  std::size_t total = 0;
  for (const std::size_t c : counts) total += c;
  const std::vector<double> predicted = mean_shares(prediction.classes, known.labels);
  for (const int k_int : fit.classes.order) {
    const auto k = static_cast<std::size_t>(k_int);
    findings.note(fmt::format(
        "{}: {:.1f} % of the ground, {:.1f} % as fitted, {} colours", known.classes[k].name,
        100.0 * static_cast<double>(counts[k]) / static_cast<double>(total), 100.0 * predicted[k],
        std::count(fit.parent.begin(), fit.parent.end(), k_int)));
    if (const ClassTexture& texture = textures[k]; texture.strength > 0.0)
      findings.note(
          fmt::format("  texture: patches up to {:.0f} m, gain {:.2f}, bumps of ±{:.1f} m",
                      texture.noise.scale_m, texture.noise.gain, texture.roughness_m));
  }
  if (fit.classes.saturated > 0)
    findings.note(
        fmt::format("{} of {} functions are saturated: their classes occur in less than half of "
                    "the range, where a mean of 1/2 cannot be",
                    fit.classes.saturated, known.classes.size() * fit.ranges.size()));
}

int run(const LayersFitOptions& options) {
  check_options(options);
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  FitFindings findings;
  const FitGround ground = read_fit_ground(options.from, findings, progress);
  KnownGround known = find_ground_classes(options.from, ground, findings, progress);
  known.input_names = inputs_of(options);
  const LayerClimateGrids climate =
      climate_of(options.climate, ground.dem, known.input_names, progress);
  for (const std::string& source : climate.sources) findings.note(source);
  known.inputs = layer_inputs(make_layer_ground(ground.dem, climate.view(), known.input_names));
  progress.begin("fitting functions", 0.0);
  GroundFitParameters parameters;
  parameters.model = options.model == "product" ? LayerModel::product : LayerModel::additive;
  parameters.functions =
      options.functions == "fitted" ? FunctionSource::fitted : FunctionSource::histogram;
  parameters.smoothing = options.smoothing.value_or(parameters.smoothing);
  parameters.roughness = options.roughness;
  const GroundFit fit = fit_ground(known, parameters);
  if (known.picture) refuse_cloud(options, known, fit);
  const GroundPrediction prediction = predict_ground(known, fit);
  const std::vector<ClassTexture> textures = class_textures(known, fit, prediction);
  note_fit(known, fit, prediction, textures, findings);
  const std::string name = file_name(options.out).substr(0, file_name(options.out).find('.'));
  const SurfaceLayers layers =
      with_textures(surface_layers_of(known, fit, name), known, fit, textures);
  const std::string text = surface_layers_text(layers);
  if (!options.report.empty())
    write_layers_fit_report(
        options.report,
        {.title = fmt::format(
             "{} from {}", file_name(options.out),
             file_name(options.from.image.empty() ? options.from.classes : options.from.image)),
         .command = fmt::format(
             "belvedere layers fit --dem {} {} --out {} --report {}", file_name(options.from.dem),
             options.from.image.empty()
                 ? fmt::format("--classes {} --legend {}", file_name(options.from.classes),
                               file_name(options.from.legend))
                 : fmt::format("--image {}", file_name(options.from.image)),
             file_name(options.out), file_name(options.report)),
         .notes = findings.notes,
         .ground = &known,
         .fit = &fit,
         .parameters = parameters,
         .layers = layers,
         .file = file_name(options.out)},
        progress);
  write_text_file(options.out, text);
  progress.end();
  if (!options.quiet) {
    print_out(fmt::format("{}: {} layers, {:.1f} KB\n", options.out, layers.layers.size(),
                          static_cast<double>(text.size()) / 1000.0));
    for (const std::string& note : findings.notes) print_out("  " + note + "\n");
  }
  return 0;
}

}  // namespace

Action add_layers_fit(CommandOptions& command) {
  const auto options = std::make_shared<LayersFitOptions>();
  command.add_option("--dem FILE", options->from.dem, "The ground: a DEM")
      .required()
      .files(FileUse::input);
  add_elevation_options(command, options->from.elevation);
  command
      .add_option("--image FILE", options->from.image,
                  "A satellite image of it: a GeoTIFF (the DEM is resampled to its cells), or PNG "
                  "or JPEG with one pixel per cell of the DEM")
      .files(FileUse::input);
  command
      .add_option("--classes FILE", options->from.classes,
                  "Instead of a picture: a land-cover raster")
      .files(FileUse::input);
  command.add_option("--legend NAME", options->from.legend,
                     "Meaning of its codes: a legend's name or file (docs/legends.md)");
  command
      .add_option("--out TOML", options->out,
                  "The layers: a .toml file of about ten KB, which no longer needs the picture")
      .required()
      .files(FileUse::writes);
  add_ground_climate(command, options->climate);
  command
      .add_option("--mask FILE", options->from.mask,
                  "Mask: cells above 0 are not learned from (fields, towns)")
      .files(FileUse::input);
  command
      .add_option("--regions FILE", options->from.regions,
                  "Which colours of the picture form one class, drawn by hand: a .toml file "
                  "(docs/layers_fit.md)")
      .files(FileUse::input);
  command
      .add_option("--bands N", options->from.bands,
                  "Bands of the image for red, green and blue, from 1, and for shortwave infrared, "
                  "which tells snow from clouds: R,G,B[,I]. Default: 1,2,3")
      .list(',');
  command.add_flag("--haze", options->from.haze,
                   "Take the blue cast of the air out of a picture in natural colours");
  command.add_option("--grey-hue DEG", options->from.grey_hue_deg,
                     "Give greys a hue of their own, as first published, such as 300 for purple");
  command.add_option("--snow-from M", options->from.snow_from_m,
                     "Lowest altitude of snow: white below it is not learned from, m");
  command.add_option(
      "--functions HOW", options->functions,
      "How functions are found: fitted by likelihood (the default), or histogram, as "
      "first published");
  command.add_option(
      "--model NAME", options->model,
      "product (the default): coverage is the product of functions; additive: shares "
      "by their sum, finer, larger");
  command.add_option("--smoothing SAMPLES", options->smoothing,
                     "Blur of histograms, in 256ths of an input's range. Default: 2");
  command.add_option(
      "--roughness WEIGHT", options->roughness,
      "Penalty on steps of fitted functions; larger is smoother. Default: 0.0006 for a "
      "product, 0.002 for a sum");
  command
      .add_option("--inputs NAMES", options->inputs,
                  "Inputs of the functions, instead of those that suit the model: altitude,slope,… "
                  "(docs/layers.md)")
      .list(',');
  command
      .add_option("--report DIR", options->report,
                  "A folder for a page on the fit and how it does on ground not used for it; takes "
                  "a minute")
      .files(FileUse::folder);
  command.add_option("--threads N", options->threads,
                     "Processor threads; 0, the default, takes all. Changes no bit");
  command.add_flag("-q,--quiet", options->quiet, "Print nothing but errors");
  command.footer(
      "Finds clouds and their shadows, the sun and the classes of colours in the picture, and how "
      "each depends on altitude, slope, sun …\n"
      "\n"
      "  belvedere layers fit --dem ararat.tif --image autumn.tif --out ararat.layers.toml "
      "--report ararat_report");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
