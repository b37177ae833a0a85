#include "tools/cli/scene_options.h"

#include <fmt/format.h>

#include <cstdint>
#include <memory>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/text/embedded.h"
#include "renderer/image/layers/layer_file.h"
#include "renderer/scene/scene_lock.h"
#include "terrain/io/http_access.h"
#include "tools/cli/terminal.h"

namespace belvedere::tools {

void add_file_options(CommandOptions& command, SceneOptions& options) {
  command
      .add_option(
          "--data DIR", options.files.data_folders,
          "A folder with files of the scene, searched after the scene's own; may be repeated")
      .repeated();
  command.add_flag("--allow-http", options.allow_http,
                   "Allows addresses (https://…) of rasters; otherwise no server is contacted");
  command
      .add_option("--http-silence S", options.http_silence_s,
                  "Timeout in seconds: how long a server may send nothing before the connection "
                  "counts as lost")
      .show_default()
      .range(1, 3600);
}

void add_run_options(CommandOptions& command, SceneOptions& options) {
  command
      .add_option(
          "--memory MIB", options.memory_mib,
          "Memory that the program may use; 0, the default, is three quarters of the machine's")
      .range(0, 1 << 30);
  command.add_flag("--no-cache", options.no_cache,
                   "Does not use the cache: computes everything again and keeps nothing; see "
                   "belvedere cache list. Changes no pixel");
  add_run_options(command, static_cast<RunOptions&>(options), "pixel");
}

void add_scene_options(CommandOptions& command, SceneOptions& options, const std::string& meaning) {
  command.add_option("SCENE", options.scene, meaning);
  add_file_options(command, options);
  command
      .add_option("--set KEY=VALUE", options.files.settings,
                  "Overrides a key of the scene: --set output.width=1200, --set exemplar.0.seed=3; "
                  "may be repeated")
      .repeated();
  add_run_options(command, options);
}

void add_locked_option(CommandOptions& command, SceneOptions& options) {
  command.add_flag(
      "--locked", options.locked,
      "Renders only if the inputs match the scene's lock file byte for byte; see belvedere lock");
}

void add_layers_option(CommandOptions& command, std::vector<std::string>& layers) {
  std::vector<std::string> extensions;
  for (const LayerFormat& format : layer_formats()) extensions.push_back(format.extension);
  command
      .add_option(fmt::format("--layers {},…", fmt::join(extensions, "|")), layers,
                  "Also writes the picture in layers (ground, strokes, trees, houses …) as "
                  "panorama.ora (GIMP, Krita; 16 bits), panorama.psd (Photoshop, Affinity; 16 "
                  "bits) or panorama_layers.exr (Nuke, Natron, Blender; linear light)")
      .list(',')
      .one_of(extensions);
}

void allow_servers(const SceneOptions& options) {
  if (!options.allow_http) return;
  const bool quiet = options.quiet;
  static std::unique_ptr<HttpAccess> access;  // as long as the program runs
  access = std::make_unique<HttpAccess>(
      HttpParameters{.silence_s = options.http_silence_s, .tell = [quiet](const std::string& text) {
                       if (!quiet) print_error("note: " + text + "\n");
                     }});
}

LoadedScene load(const SceneOptions& options) {
  allow_servers(options);
  if (!options.scene.empty()) {
    LoadedScene scene = read_scene(options.scene, options.files);
    guard_inputs(scene);
    if (options.locked)
      require_locked_inputs(scene, read_lock(lock_path(options.scene)), options.scene);
    return scene;
  }
  if (options.locked)
    throw Error(ErrorKind::usage, "--locked", "the built-in demo has no lock file", "a scene file");
  const std::string demo(embedded_file("scenes/demo/demo.toml"));
  LoadedScene scene = parse_scene(demo, "demo.toml", ".", options.files);
  guard_inputs(scene);
  return scene;
}

Cache make_cache(const SceneOptions& options) {
  return Cache(
      {.folder = options.no_cache ? std::string() : user_cache_folder(), .limit_bytes = 0});
}

Run make_run(const SceneOptions& options, int tile_px, Progress& progress, const Cache& cache) {
  constexpr int mib_bits = 20;
  return {.threads = options.threads,
          .memory_bytes = static_cast<std::uint64_t>(options.memory_mib) << mib_bits,
          .tile_px = tile_px,
          .progress = progress,
          .cache = cache};
}

}  // namespace belvedere::tools
