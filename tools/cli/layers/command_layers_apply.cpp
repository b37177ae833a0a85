#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "terrain/io/raster_file.h"
#include "terrain/layers/layer_apply.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layers_file.h"
#include "tools/cli/commands.h"
#include "tools/cli/layers/ground_climate_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

struct LayersApplyOptions : RunOptions {
  std::string layers, dem, out, colour, shares;
  ElevationOptions elevation;
  GroundClimateOptions climate;
  LayerApplyParameters apply;
};

ByteRasterLayout class_layout(const RasterFrame& frame) {
  ByteRasterLayout layout{.frame = frame, .bands = {{.name = "class"}}, .zero_is_void = true};
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (info.id != LandCoverClass::sky)
      layout.codes.push_back(
          {static_cast<std::uint8_t>(info.id), std::string(info.name), info.rgb});
  return layout;
}

// So that a scene can read the classes as land cover.
std::string legend_text(const std::string& name) {
  std::string out = fmt::format(
      "# Legend of {}.\n"
      "name = {}\n"
      "nodata = [0]\n"
      "\n"
      "[codes]\n",
      name, json_quoted(name));
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (info.id != LandCoverClass::sky)
      out += fmt::format("{} = {{ label = {}, class = \"{}\" }}\n", static_cast<int>(info.id),
                         json_quoted(info.meaning), info.name);
  return out;
}

std::string legend_path(const std::string& classes) {
  return std::filesystem::path(classes).replace_extension(".legend.toml").string();
}

std::vector<std::string> classes_files(const std::string& path) {
  return {path, legend_path(path)};
}

std::string as_text(const LayersApplyOptions& options, const SurfaceLayers& layers, const Dem& dem,
                    const LayerApplyResult& result) {
  std::string out = fmt::format("{}: {}×{} cells\n", options.out, dem.width(), dem.height());
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (const double share = result.class_share[static_cast<std::size_t>(info.id)]; share > 0.0)
      out += fmt::format("  {:<14} {:5.1f} %\n",
                         info.id == LandCoverClass::sky ? "(no class)" : info.name, 100.0 * share);
  if (!layers.inputs.empty()) out += "outside the range that the layers cover:\n";
  for (std::size_t i = 0; i < layers.inputs.size(); ++i)
    out += fmt::format("  {:<14} {:5.1f} %\n", layers.inputs[i].name, 100.0 * result.outside[i]);
  return out;
}

Json as_json(const LayersApplyOptions& options, const SurfaceLayers& layers, const Dem& dem,
             const LayerApplyResult& result) {
  Json classes = Json::object();
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (info.id != LandCoverClass::sky)
      classes.add(info.name, Json::number(result.class_share[static_cast<std::size_t>(info.id)]));
  Json outside = Json::object();
  for (std::size_t i = 0; i < layers.inputs.size(); ++i)
    outside.add(layers.inputs[i].name, Json::number(result.outside[i]));
  return Json::object()
      .add("out", Json::text(options.out))
      .add("width", Json::number(dem.width()))
      .add("height", Json::number(dem.height()))
      .add("classes", std::move(classes))
      .add("outside", std::move(outside))
      .add("warnings", Json::texts(range_warnings(layers, result)));
}

int run(const LayersApplyOptions& options) {
  const ThreadLimit threads(options.threads);
  TerminalProgress progress(options.quiet);
  const SurfaceLayers layers = read_surface_layers(options.layers);
  if (layers.layers.empty())
    throw Error(ErrorKind::usage, options.layers, "no layers", "at least one [[layers]]");
  const Dem dem =
      read_layer_dem(options.dem, options.elevation, progress);  // voids stay without a class
  const RasterFrame frame{dem.transform, dem.width(), dem.height(), dem.crs};
  const LayerClimateGrids climate =
      climate_of(options.climate, dem, compile_layers(layers).inputs, progress);

  LayerApplyParameters apply = options.apply;
  apply.colour = !options.colour.empty();
  apply.coverage = !options.shares.empty();
  ByteRasterRows classes(options.out, class_layout(frame));
  std::optional<ByteRasterRows> colour;
  if (apply.colour)
    colour.emplace(options.colour,
                   ByteRasterLayout{.frame = frame, .bands = {{}, {}, {}}, .is_colour = true});
  std::optional<ByteRasterRows> shares;
  if (apply.coverage) {
    ByteRasterLayout layout{.frame = frame};
    for (const SurfaceLayer& layer : layers.layers)
      layout.bands.push_back({layer.name, 1.0 / 255.0});
    shares.emplace(options.shares, layout);
  }
  const LayerApplyResult result = apply_layers(
      layers, dem, climate.view(), apply,
      [&](const LayerStrip& strip) {
        Grid<std::uint8_t> codes(strip.classes.width(), strip.classes.height());
        for (int y = 0; y < codes.height(); ++y)
          for (int x = 0; x < codes.width(); ++x)
            codes(x, y) = dem.filled(x, strip.y0 + y) != 0
                              ? std::uint8_t{0}
                              : static_cast<std::uint8_t>(strip.classes(x, y));
        classes.write(strip.y0, {codes});
        if (colour) colour->write(strip.y0, strip.colour);
        if (shares) shares->write(strip.y0, strip.coverage);
      },
      progress);
  progress.begin("writing", 0.0);
  classes.prepare();
  if (colour) colour->prepare();
  if (shares) shares->prepare();
  write_text_file(legend_path(options.out), legend_text(file_name(options.out)));
  classes.commit();
  if (colour) colour->commit();
  if (shares) shares->commit();
  for (const std::string& warning : range_warnings(layers, result))
    progress.note("warning: " + warning);
  progress.end();
  print_result(options, as_json(options, layers, dem, result),
               as_text(options, layers, dem, result));
  return 0;
}

}  // namespace

Action add_layers_apply(CommandOptions& command) {
  const auto options = std::make_shared<LayersApplyOptions>();
  command.add_option("LAYERS FILE", options->layers, "The layers: a .toml file (docs/layers.md)")
      .required()
      .files(FileUse::input);
  command
      .add_option("--dem FILE", options->dem,
                  "The ground: a DEM; the results have its cells, in metres")
      .required()
      .files(FileUse::input);
  add_elevation_options(command, options->elevation);
  command
      .add_option(
          "--out TIF", options->out,
          "The classes: a GeoTIFF of bytes, with a legend beside it, so that scenes can read it")
      .required()
      .files(FileUse::writes, classes_files);
  command
      .add_option("--colour TIF", options->colour,
                  "The colours of the layers, blended by their coverage: a GeoTIFF")
      .files(FileUse::writes);
  command
      .add_option(
          "--shares TIF", options->shares,
          "How much of each cell each layer covers: a GeoTIFF with a band for each, 255 is all")
      .files(FileUse::writes);
  add_ground_climate(command, options->climate);
  LayerDrawingParameters& drawing = options->apply.drawing;
  command.add_option(
      "--sharpen POWER", drawing.power,
      "How little classes mix where shares are divided: from 1, as the shares are, to "
      "4. Default: 2");
  command.add_option(
      "--patches SIZE", drawing.spectrum,
      "Size of patches: from 0, speckled, to 4, large with smooth borders. Default: 0");
  command.add_option("--seed N", options->apply.seed, "Random seed. Default: 1");
  add_run_options(command, *options, "cell");
  command.footer(
      "Reports how much of the ground each class covers, and how much of it lies outside the range "
      "of altitudes, slopes … that the\n"
      "layers cover. Beyond 10 % it warns, because classes are extrapolated there.\n"
      "\n"
      "  belvedere layers apply innsbruck.layers.toml --dem innsbruck.tif --out classes.tif "
      "--colour colour.tif");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
