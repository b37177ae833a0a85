#include "tools/cli/scene_options.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "base/embedded.h"
#include "base/error.h"

namespace belvedere::tools {

void add_scene_options(CLI::App& command, SceneOptions& options, const std::string& meaning) {
  command.add_option("SCENE", options.scene, meaning);
  command
      .add_option("--data", options.files.data_folders,
                  "A folder in which the scene's files may lie, beside the scene's own; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command
      .add_option("--set", options.files.settings,
                  "Overrides a key of the scene: --set output.width=1200, --set exemplar.0.seed=3; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--threads", options.threads, "How many processor threads to use; 0, the default, takes all. Changes no pixel")
      ->type_name("N")
      ->check(CLI::Range(0, 4096));
  command.add_option("--memory", options.memory_mib, "Memory that pictures may take; 0, the default, is three quarters of the machine's")
      ->type_name("MIB")
      ->check(CLI::Range(0, 1 << 30));
  command.add_flag("--quiet,-q", options.quiet, "No progress, no notes");
  command.add_flag("--json", options.json, "The result as JSON on standard output");
}

void limit_memory(const SceneOptions& options) {
  if (options.memory_mib > 0) setenv("BELVEDERE_MEMORY_MIB", std::to_string(options.memory_mib).c_str(), 1);
}

LoadedScene load(const SceneOptions& options) {
  limit_memory(options);
  if (!options.scene.empty()) return read_scene(options.scene, options.files);
  return parse_scene(std::string(embedded_file("scenes/demo/demo.toml")), "demo.toml", ".", options.files);
}

}  // namespace belvedere::tools
