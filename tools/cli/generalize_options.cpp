#include "tools/cli/generalize_options.h"

#include <fmt/format.h>

#include "base/error.h"
#include "terrain/generalize/generalize_presets.h"
#include "tools/cli/commands.h"
#include "tools/options/options.h"

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

void add_weights(CommandOptions& command, const char* name, Weights& weights, const char* meaning) {
  command.add_option(name, weights, meaning).type_name("W1,…,WN").list(',');
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
      .add_option("--preset", options.preset,
                  "Named weights and masks; options given with it override them")
      .type_name("NAME")
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
      .add_option("--base", options.bands.base,
                  "Weight of what is larger than all bands: raises or lowers the land as a whole, "
                  "by a share of its altitude")
      .type_name("W")
      .show_default()
      .range(0.0, 5.0);
  const Option viewer = command
                            .add_option("--viewer", options.viewer,
                                        "Position of the viewer, in the DEM's coordinates")
                            .type_name("E,N")
                            .list(',', 2);
  command
      .add_option("--distances", options.distances,
                  "Metres: only foreground up to the first, only background from the second")
      .type_name("NEAR,FAR")
      .list(',', 2)
      .needs(viewer);
  command
      .add_option("--mask", options.mask,
                  "Raster mask: 0 unchanged, 1 (or 255) generalized; any grid and coordinates")
      .type_name("FILE")
      .files(FileUse::input);
  command
      .add_option("--mask-slope", options.mask_slope,
                  "Degrees: ground flatter than the first is unchanged, steeper than the second is "
                  "generalized")
      .type_name("FLAT,STEEP")
      .list(',', 2);
  command.add_flag(
      "--automatic-mask", options.automatic_mask,
      "Applies no exaggeration to flat ground at the foot of slopes, where it would dig moats");
  command.add_flag("--change-lakes", options.change_lakes,
                   "Generalizes lakes like land; otherwise they keep their level");
  command
      .add_option(
          "--curvature", options.curvature,
          "Curvature that finds ridges: bounded is quiet in flats, plan also finds gentle ones")
      .type_name("bounded|plan")
      .show_default()
      .one_of({"bounded", "plan"});
  command
      .add_option("--full-curvature", options.bands.full_curvature,
                  "Curvature times cell size of a full ridge; a smaller value makes more of the "
                  "ground a ridge. 0: 0.15 for bounded, 0.8 for plan")
      .type_name("X")
      .range(0.0, 10.0);
  command
      .add_option("--blur", options.bands.blur_cells,
                  "Width of the transition between ridge and slope, in cells of each band")
      .type_name("CELLS")
      .show_default()
      .range(0.0, 10.0);
  command
      .add_option("--exponent", options.bands.exponent,
                  "1: detail on ridges and valley lines only; towards 0 slopes keep theirs too")
      .type_name("X")
      .show_default()
      .range(0.0, 4.0);
  add_terrain_operators(command, options.operators);
  command
      .add_option(
          "--report", options.report,
          "Also writes a folder with a page of pictures and numbers: index.html, report.json")
      .type_name("DIR")
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

}  // namespace belvedere::tools
