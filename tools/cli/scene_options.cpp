#include "tools/cli/scene_options.h"

#include <CLI/CLI.hpp>
#include <cstdint>

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

LoadedScene load(const SceneOptions& options) {
  if (!options.scene.empty()) return read_scene(options.scene, options.files);
  const std::string demo(embedded_file("scenes/demo/demo.toml"));
  return parse_scene(demo, "demo.toml", ".", options.files);
}

Run make_run(const SceneOptions& options, int tile_px, Progress& progress) {
  constexpr int mib_bits = 20;
  return {.threads = options.threads,
          .memory_bytes = static_cast<std::uint64_t>(options.memory_mib) << mib_bits,
          .tile_px = tile_px,
          .progress = progress};
}

}  // namespace belvedere::tools
