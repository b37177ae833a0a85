#pragma once

#include <string>

#include "base/run.h"
#include "renderer/scene/scene_file.h"
#include "tools/options/options.h"

namespace belvedere::tools {

class CommandOptions;

// Options shared by every command that takes a scene.
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
                       const std::string& meaning = "The scene file. Default: the built-in demo");
// Adds the options of commands with several scenes: --data and --allow-http, and threads, memory,
// quiet, json.
void add_file_options(CommandOptions& command, SceneOptions& options);
void add_run_options(CommandOptions& command, SceneOptions& options);
// --locked, which load() then enforces.
void add_locked_option(CommandOptions& command, SceneOptions& options);
// Formats of layers, as in renderer/image/layers/layer_file.h.
void add_layers_option(CommandOptions& command, std::vector<std::string>& layers);
// Allows access to servers for the rest of the program, if the options do.
void allow_servers(const SceneOptions& options);
// Reads the scene or the demo; its inputs must match its lock if that is asked for.
LoadedScene load(const SceneOptions& options);
// The user's cache; none with --no-cache.
Cache make_cache(const SceneOptions& options);
// Job settings from the command line.
Run make_run(const SceneOptions& options, int tile_px = Run{}.tile_px,
             Progress& progress = silent_progress(), const Cache& cache = no_cache());

}  // namespace belvedere::tools
