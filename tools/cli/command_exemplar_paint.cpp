#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/text/json.h"
#include "renderer/exemplar/exemplar_files.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

struct ExemplarPaintOptions {
  SceneOptions scene;
  std::string plan;
  std::string out;
  std::optional<std::string> season;
  std::optional<int> size;
  std::optional<double> dots_per_inch;
  std::optional<std::uint64_t> seed;
  int tile_size = 32;
  bool force = false;
};

void refuse_example_sheet_options(const ExemplarPaintOptions& options) {
  const char* given = nullptr;
  if (options.size) given = "--size";
  if (options.dots_per_inch) given = "--dpi";
  if (!options.plan.empty()) given = "--plan";
  if (given != nullptr)
    throw Error(ErrorKind::usage, given, "is an option of example sheets, but a scene is given",
                "--set output.width=…, output.height and output.sheet_width_mm");
}

AvailableTexels paint_scene(const ExemplarPaintOptions& options, const Run& run) {
  refuse_example_sheet_options(options);
  SceneOptions scene = options.scene;
  if (options.season) scene.files.settings.push_back("palette=" + *options.season);
  if (options.seed) scene.files.settings.push_back(fmt::format("seed={}", *options.seed));
  return write_scene_exemplar(load(scene), options.out, run);
}

AvailableTexels paint_example_sheet_of(const ExemplarPaintOptions& options, const Run& run) {
  if (!options.scene.files.settings.empty())
    throw Error(ErrorKind::usage, "--set", "changes a scene, but an example sheet has none",
                "--plan with your own sheet.toml");
  ExampleSheetPlan plan =
      options.plan.empty() ? built_in_example_sheet_plan() : read_example_sheet_plan(options.plan);
  if (options.season) plan.palette = *options.season;
  if (options.size) plan.width = plan.height = *options.size;
  if (options.dots_per_inch) plan.dots_per_inch = *options.dots_per_inch;
  if (options.seed) plan.seed = *options.seed;
  return write_example_sheet(plan, options.out, run);
}

int run(const ExemplarPaintOptions& options) {
  const bool example_sheet = options.scene.scene.empty();
  const std::vector<std::string> names = {"painting.tif",
                                          "ground.tif",
                                          "painting.png",
                                          "guidance.exr",
                                          example_sheet ? "sheet.toml" : "scene.toml",
                                          "coverage.json"};
  file_guard().writes_into(options.out, "--out", options.force, names);
  TerminalProgress progress(options.scene.quiet);
  const Cache cache = make_cache(options.scene);
  const Run run = make_run(options.scene, options.tile_size, progress, cache);
  const RunLimits limits(run);
  const AvailableTexels available =
      example_sheet ? paint_example_sheet_of(options, run) : paint_scene(options, run);
  progress.end();

  const std::vector<TexelShortage> gaps = find_gaps(available, built_in_needed_texels(), {});
  if (options.scene.json) {
    print_out(available_json(available, gaps));
  } else if (!options.scene.quiet) {
    // A view may lack classes; only an example sheet should have everything.
    print_out(available_text(available, example_sheet ? gaps : std::vector<TexelShortage>{},
                             example_sheet));
    for (const std::string& name : names)
      print_out((std::filesystem::path(options.out) / name).string() + "\n");
  }
  return 0;
}

}  // namespace

Action add_exemplar_paint(CommandOptions& command) {
  const auto options = std::make_shared<ExemplarPaintOptions>();
  add_scene_options(command, options->scene,
                    "A scene whose view is painted. Default: an example sheet of synthetic views");
  command.add_option("--out DIR", options->out, "Folder for the results; created if missing")
      .required()
      .files(FileUse::later);
  command.add_option(
      "--season PALETTE", options->season,
      "Palette: summer, autumn, winter, steppe, high_desert, desert, evening, morning or a "
      ".toml file. "
      "Default of an example sheet: summer");
  command
      .add_option("--size PX", options->size, "Side of the example sheet in pixels. Default: 4096")
      .range(256, 16384);
  command
      .add_option("--dpi DPI", options->dots_per_inch,
                  "Resolution that the example sheet's strokes are sized for, that of the panorama "
                  "that will copy them. Default: 50.8")
      .range(5.0, 2540.0);
  command.add_option("--seed N", options->seed, "Random seed of mountains and strokes")
      .range(std::uint64_t{0}, ExampleSheetPlan::largest_seed);
  command
      .add_option("--plan FILE", options->plan,
                  "A sheet.toml: paints that example sheet instead of the built-in one")
      .files(FileUse::input);
  command.add_force(options->force);
  command
      .add_option("--tile N", options->tile_size,
                  "Side of the tiles that threads work on, in pixels. Changes no pixel")
      .show_default()
      .range(8, 4096);
  command.footer(
      "Writes painting.tif, ground.tif (without trees and houses), painting.png, guidance.exr, "
      "sheet.toml or\n"
      "scene.toml (the input) and coverage.json (what there is to copy). A scene copies it with\n"
      "[[exemplar]] picture = \"ground.tif\", guidance = \"guidance.exr\".\n"
      "\n"
      "  belvedere exemplar paint --season autumn --out sheet\n"
      "  belvedere exemplar paint scenes/karwendel.toml --data ../data --out karwendel_strokes");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
