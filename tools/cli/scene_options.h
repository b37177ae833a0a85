#pragma once

#include <string>

#include "base/run.h"
#include "renderer/scene/scene_file.h"

namespace CLI {
class App;
}

namespace belvedere::tools {

// What every command that takes a scene has in common.
struct SceneOptions {
  std::string scene;  // path; empty: the built-in demo
  SceneFileOptions files;
  int threads = 0;     // 0: all
  int memory_mib = 0;  // 0: three quarters of the machine's
  bool quiet = false;
  bool json = false;
};

// meaning: of the scene, in the command's help.
void add_scene_options(CLI::App& command, SceneOptions& options,
                       const std::string& meaning = "The scene file; without one the built-in demo");
// Reads the scene, or the demo.
LoadedScene load(const SceneOptions& options);
// How the job is to be done, as the command line says.
Run make_run(const SceneOptions& options, int tile_px = Run{}.tile_px, Progress& progress = silent_progress());

}  // namespace belvedere::tools
