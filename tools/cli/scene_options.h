#pragma once

#include <string>

#include "base/run.h"
#include "renderer/scene/scene_file.h"
#include "tools/options/run_options.h"

namespace belvedere::tools {

class CommandOptions;

// What every command that takes a scene has in common.
struct SceneOptions : RunOptions {
  std::string scene;  // path; empty: the built-in demo
  SceneFileOptions files;
  bool locked = false;      // inputs must be those of the scene's lock
  bool allow_http = false;  // rasters may lie on servers
  int http_silence_s = 30;  // s that a server may send nothing
  int memory_mib = 0;       // 0: three quarters of the machine's
  bool no_cache = false;
};

// meaning: of the scene, in the command's help.
void add_scene_options(CommandOptions& command, SceneOptions& options,
                       const std::string& meaning = "The scene file; without one the built-in demo");
// The parts of it that commands with several scenes take as well: --data and --allow-http, and threads, memory, quiet, json.
void add_file_options(CommandOptions& command, SceneOptions& options);
void add_run_options(CommandOptions& command, SceneOptions& options);
// --locked, which load() then holds to.
void add_locked_option(CommandOptions& command, SceneOptions& options);
// Formats of layers, as renderer/image/layers/layer_file.h has them.
void add_layers_option(CommandOptions& command, std::vector<std::string>& layers);
// Opens the way to servers for the rest of the program, where the options allow it.
void allow_servers(const SceneOptions& options);
// Reads the scene, or the demo; its inputs are those of its lock where that is asked for.
LoadedScene load(const SceneOptions& options);
// The user's cache; none where the command line says so.
Cache make_cache(const SceneOptions& options);
// How the job is to be done, as the command line says.
Run make_run(const SceneOptions& options, int tile_px = Run{}.tile_px, Progress& progress = silent_progress(),
             const Cache& cache = no_cache());

}  // namespace belvedere::tools
