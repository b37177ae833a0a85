#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/files/output_file.h"
#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/text/json.h"
#include "renderer/image/provenance.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/scene_lock.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

constexpr int usual_width_px = 800;  // quick, and every stage takes part in it

struct LockOptions {
  SceneOptions scene;
  int width = 0;  // 0: as before, else usual_width_px
  bool update = false;
};

[[noreturn]] void refuse_change(const std::string& lock, const std::string& found) {
  throw Error(ErrorKind::input, lock, found,
              "belvedere lock --update, if the new state is intended");
}

// The existing lock. With --update a damaged one counts as none.
std::optional<SceneLock> old_lock(const std::string& path, bool update) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  try {
    return read_lock(path);
  } catch (const Error&) {
    if (!update) throw;
    return std::nullopt;
  }
}

// All differences but those of pixels: they are reported before anything is rendered.
std::string describe_changes(const SceneLock& old, const SceneLock& now) {
  std::string out = describe(compare_inputs(old.inputs, now.inputs));
  const auto add = [&out](const char* what, const std::string& before, const std::string& after) {
    if (before != after) out += fmt::format("\n  {}: {} in the lock, now {}", what, before, after);
  };
  add("size", fmt::format("{}×{}", old.width, old.height),
      fmt::format("{}×{}", now.width, now.height));
  add("settings", fmt::format("[{}]", fmt::join(old.settings, ", ")),
      fmt::format("[{}]", fmt::join(now.settings, ", ")));
  add("the scene with its defaults", old.scene, now.scene);
  add("program", old.program, now.program);
  return out;
}

int run_lock(LockOptions options) {
  const std::string path = lock_path(options.scene.scene);
  file_guard().writes(path, "SCENE");
  const std::optional<SceneLock> old = old_lock(path, options.update);
  // Locked with the same settings as before, unless the command line gives others.
  if (old && options.scene.files.settings.empty()) options.scene.files.settings = old->settings;
  const LoadedScene as_written = load(options.scene);
  const int width = options.width > 0 ? options.width
                    : old             ? old->width
                                      : std::min(usual_width_px, as_written.scene.output.width);
  const LoadedScene scene = at_width(as_written, width);
  SceneLock lock{.program = program_version(),
                 .scene = hash_scene(scene.scene),
                 .width = scene.scene.output.width,
                 .height = scene.scene.output.height,
                 .settings = options.scene.files.settings,
                 .inputs = find_inputs(scene),
                 .products = {}};
  if (old && !options.update)
    if (const std::string changes = describe_changes(*old, lock); !changes.empty())
      refuse_change(path, "the scene differs from its lock:" + changes);

  const ScratchFolder folder;
  TerminalProgress progress(options.scene.quiet);
  lock.products =
      render_and_hash(scene, folder.path(), make_run(options.scene, Run{}.tile_px, progress));
  progress.end();
  if (old && !options.update)
    if (const std::string changes = describe(compare_products(old->products, lock.products));
        !changes.empty())
      refuse_change(path, "the pictures differ from their lock:" + changes);
  write_text_file(path, write_lock(lock));

  print_result(options.scene,
               Json::object()
                   .add("lock", Json::text(path))
                   .add("width", Json::number(lock.width))
                   .add("height", Json::number(lock.height))
                   .add("inputs", Json::number(static_cast<double>(lock.inputs.size())))
                   .add("products", Json::number(static_cast<double>(lock.products.size()))),
               fmt::format("{}: {} inputs; {} files of {}×{} pixels\n", path, lock.inputs.size(),
                           lock.products.size(), lock.width, lock.height));
  return 0;
}

}  // namespace

Action add_lock(CommandOptions& command) {
  const auto options = std::make_shared<LockOptions>();
  add_scene_options(command, options->scene, "The scene file");
  command.option("SCENE").required();
  command
      .add_option("--width", options->width,
                  "Width of the verified picture in pixels, its height in proportion. Default: as "
                  "in the existing lock, else 800, or the scene's if that is less")
      .type_name("PX")
      .range(16, 65535);
  command.add_flag("--update", options->update,
                   "Rewrites the lock if something differs from the existing one");
  command.footer(
      "Writes SCENE.lock beside SCENE.toml: size and hash of every file that the scene reads, the "
      "program's version,\n"
      "and the hash of the pixels of each channel. Keep it with the scene. Then\n"
      "  belvedere render --locked SCENE.toml   renders only if the inputs are unchanged\n"
      "  belvedere verify *.toml                checks whether the pictures are unchanged\n"
      "If a lock exists and something differs, the command lists the differences (exit status 3) "
      "and keeps the lock.\n"
      "\n"
      "  belvedere lock scenes/karwendel.toml --data ../data");
  return [options] { return run_lock(*options); };
}

}  // namespace belvedere::tools
