#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/cache/cache.h"
#include "base/text/json.h"
#include "renderer/image/layers/layer_file.h"
#include "renderer/image/picture_formats.h"
#include "renderer/pipeline/named_picture.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/world/scene_dem.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

struct RenderOptions {
  SceneOptions scene;
  std::string out;
  int tile_size = 32;
  std::vector<int> part;  // x, y, width, height
  bool resume = false;
  int piece_px = 0;
  bool draft = false;
  bool match = false;
  std::vector<std::string> layers;
  std::string channels;
  bool force = false;
};

enum class Wanted { guidance, picture };

int run_job(const RenderOptions& options, Wanted wanted) {
  LoadedScene scene = load(options.scene);
  if (options.draft) scene = make_draft_scene(std::move(scene));
  const std::string folder = options.out.empty() ? scene.name : options.out;
  TerminalProgress progress(options.scene.quiet);
  const Cache cache = make_cache(options.scene);
  SheetRequest request;
  request.panorama = wanted == Wanted::picture;
  request.resume = options.resume;
  request.piece_px = options.piece_px;
  if (!options.part.empty()) {
    const std::vector<int>& p = options.part;
    request.part = PixelRect{p[0], p[1], p[0] + p[2], p[1] + p[3]};
  }
  request.matches = options.match;
  request.layers = options.layers;
  request.replace = options.force;
  if (!options.channels.empty()) request.channels = read_guidance_choice(options.channels);
  render(scene, folder, make_run(options.scene, options.tile_size, progress, cache), request);
  progress.end();

  std::vector<std::string> paths;
  for (const std::string& name : result_names(scene.scene, request))
    if (const std::filesystem::path path = std::filesystem::path(folder) / name;
        std::filesystem::exists(path))
      paths.push_back(path.string());
  for (const PictureFormat& format : picture_formats())
    if (const std::string path =
            (std::filesystem::path(folder) / fmt::format("panorama.{}", format.extension)).string();
        request.panorama && std::filesystem::exists(path) &&
        std::find(paths.begin(), paths.end(), path) == paths.end() && !options.scene.quiet)
      print_error(
          fmt::format("note: {} is of an earlier run; pdf, proof and web take the pictures "
                      "of this one\n",
                      path));
  if (options.scene.json) {
    Json files = Json::array();
    for (const std::string& path : paths)
      files.add(Json::object()
                    .add("path", Json::text(path))
                    .add("bytes", Json::raw(fmt::format("{}", std::filesystem::file_size(path)))));
    print_out(Json::object()
                  .add("scene", Json::text(scene.name))
                  .add("width", Json::number(scene.scene.output.width))
                  .add("height", Json::number(scene.scene.output.height))
                  .add("files", std::move(files))
                  .str() +
              "\n");
  } else if (!options.scene.quiet) {
    for (const std::string& path : paths) print_out(path + "\n");
  }
  return 0;
}

Action add_job(CommandOptions& command, const char* footer, Wanted wanted) {
  const auto options = std::make_shared<RenderOptions>();
  add_scene_options(command, options->scene);
  add_locked_option(command, options->scene);
  command
      .add_option("--out DIR", options->out,
                  "Folder for the results; created if missing. Default: named like the scene")
      .files(FileUse::later);
  command
      .add_option("--tile N", options->tile_size,
                  "Side of the tiles that threads work on, in pixels. Changes no pixel")
      .show_default()
      .range(8, 4096);
  command
      .add_option("--part X,Y,W,H", options->part,
                  "Only a rectangle of the sheet, as x,y,width,height in its pixels, as a proof")
      .list(',', 4);
  command
      .add_option("--piece N", options->piece_px,
                  "Side of the pieces that are finished one after the other, in pixels; 0, the "
                  "default, is 1024. Changes no pixel")
      .range(0, 4096);
  command.add_flag(
      "--resume", options->resume,
      "Resumes a run that was stopped in this folder; the files are the same as without the stop");
  command.add_force(options->force);
  command.add_option(
      "--channels NAME,…|none|blender", options->channels,
      "Channels of guidance.exr, such as Z,landcover.id; none: no file; blender: named for "
      "compositing programs, with masks by name. Default: all, 40 bytes per pixel");
  if (wanted == Wanted::picture)
    command.add_flag("--match", options->match,
                     "Also writes match.exr: which texel of which picture each pixel was copied "
                     "from, for synthesize --replay. Needs a scene that copies texture");
  if (wanted == Wanted::picture) add_layers_option(command, options->layers);
  if (wanted == Wanted::picture)
    command.add_flag(
        "--draft", options->draft,
        "A quick preview, in seconds: a third of the pixels per side, one ray per "
        "pixel, fewer sky directions, at most 2.5 million cells of ground, only strokes "
        "without copied texture");
  command.footer(footer);
  return [options, wanted] { return run_job(*options, wanted); };
}

}  // namespace

Action add_render(CommandOptions& command) {
  return add_job(
      command,
      "Writes panorama.tif (16 bit, with profile and resolution), panorama.png, panorama.exr "
      "(scene-linear),\n"
      "or the formats in output.formats, and guidance.exr (depth, classes, light … of every "
      "pixel).\n"
      "\n"
      "  belvedere render scenes/karwendel.toml --data ../data --out karwendel\n"
      "  belvedere render scenes/karwendel.toml --data ../data --draft --out draft\n"
      "  belvedere render scenes/karwendel.toml --data ../data --set output.width=1200 --set "
      "output.height=550\n"
      "  belvedere render scenes/karwendel.toml --data ../data --channels Z,landcover.id\n"
      "  belvedere render scenes/karwendel.toml --data ../data --channels blender\n"
      "  belvedere render scenes/karwendel.toml --data ../data --part 800,300,400,400 --out proof\n"
      "  belvedere render --match --out demo",
      Wanted::picture);
}

Action add_guidance(CommandOptions& command) {
  return add_job(
      command,
      "The channels and their units are described in the header: belvedere info guidance.exr\n\n"
      "  belvedere guidance scenes/karwendel.toml --data ../data --out karwendel",
      Wanted::guidance);
}

}  // namespace belvedere::tools
