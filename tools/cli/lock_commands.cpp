#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/files/output_file.h"
#include "base/text/json.h"
#include "renderer/image/provenance.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/scene_lock.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"
#include "tools/report/verification.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

struct VerifyOptions {
  SceneOptions scene;  // what the scenes share
  std::vector<std::string> scenes;
  std::string out, against, junit, page;
  bool force = false;
};

void compare(Verification& result, const VerifyOptions& options) {
  const SceneLock lock = read_lock(lock_path(result.scene));
  SceneOptions one = options.scene;
  one.scene = result.scene;
  one.files.settings = settings_of(lock);
  const LoadedScene scene = load(one);
  require_locked_inputs(scene, lock, result.scene);
  result.inputs = lock.inputs.size();
  if (lock.program != program_version())
    result.notes.push_back(
        fmt::format("locked by version {}, this is {}", lock.program, program_version()));
  if (lock.scene != hash_scene(scene.scene))
    result.notes.emplace_back(
        "the scene, or a default of the program, has changed since it was locked");

  TerminalProgress progress(options.scene.quiet);
  const std::vector<LockedProduct> products =
      render_and_hash(scene, result.folder, make_run(one, Run{}.tile_px, progress), options.force);
  progress.end();
  result.width = lock.width;
  result.height = lock.height;
  result.differences = compare_products(lock.products, products);
  std::set<std::string> names;
  for (const LockedProduct& product : lock.products) names.insert(product.file);
  for (const LockedProduct& product : products) names.insert(product.file);
  result.products.assign(names.begin(), names.end());
}

// A scene that cannot be compared does not stop the others; only the user stops all.
Verification verify(const std::string& scene, const std::string& name, const std::string& folder,
                    const VerifyOptions& options) {
  const auto begun = std::chrono::steady_clock::now();
  Verification result;
  result.scene = scene;
  result.name = name;
  result.folder = (fs::path(folder) / name).string();
  const auto fail = [&](ErrorKind kind, const std::string& text) {
    result.error_status = static_cast<int>(kind);
    result.error = text;
  };
  try {
    compare(result, options);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::interrupted) throw;
    fail(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    fail(ErrorKind::limit, "not enough memory");
  } catch (const std::exception& error) {
    fail(ErrorKind::bug, std::string("internal error: ") + error.what());
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return result;
}

// Two scenes of one name, from two folders, get their own folders: alps, alps-2.
std::string name_for(const std::string& scene, std::set<std::string>& used) {
  const std::string stem = fs::path(scene).stem().string();
  std::string name = stem;
  for (int i = 2; !used.insert(name).second; ++i) name = fmt::format("{}-{}", stem, i);
  return name;
}

std::string as_json(const std::vector<Verification>& all) {
  Json scenes = Json::array();
  for (const Verification& one : all) {
    Json differences = Json::array();
    for (const LockDifference& difference : one.differences)
      differences.add(Json::object()
                          .add("file", Json::text(difference.file))
                          .add("channel", Json::text(difference.channel))
                          .add("locked", Json::text(difference.locked))
                          .add("found", Json::text(difference.found)));
    scenes.add(Json::object()
                   .add("scene", Json::text(one.scene))
                   .add("same", Json::boolean(one.same()))
                   .add("width", Json::number(one.width))
                   .add("height", Json::number(one.height))
                   .add("notes", Json::texts(one.notes))
                   .add("differences", std::move(differences))
                   .add("error_status", Json::number(one.error_status))
                   .add("error", Json::text(one.error)));
  }
  return Json::object().add("scenes", std::move(scenes)).str() + "\n";
}

int run_verify(const VerifyOptions& options) {
  if (!options.against.empty() && !fs::is_directory(options.against))
    throw Error(ErrorKind::input, options.against, "no such folder",
                "a folder made by belvedere verify --out");
  const ScratchFolder scratch;
  const std::string folder = options.out.empty() ? scratch.path() : options.out;
  std::set<std::string> used;
  std::vector<Verification> all;
  for (const std::string& scene : options.scenes) {
    all.push_back(verify(scene, name_for(scene, used), folder, options));
    if (!options.scene.json) print_out(one_line(all.back()) + "\n");
  }
  if (options.scene.json) print_out(as_json(all));
  if (!options.junit.empty()) write_text_file(options.junit, verification_junit(all));
  if (!options.page.empty())
    write_text_file(options.page, verification_page(all, {.against = options.against,
                                                          .scratch_folder = scratch.path()}));
  return exit_status(all);
}

}  // namespace

Action add_verify(CommandOptions& command) {
  const auto options = std::make_shared<VerifyOptions>();
  command.add_option("SCENE", options->scenes, "Scene files, each with its lock file beside it")
      .required();
  add_file_options(command, options->scene);
  command.add_force(options->force);
  command
      .add_option("--out DIR", options->out,
                  "Keeps the pictures of each scene in a folder of its name")
      .files(FileUse::later);
  command.add_option(
      "--against DIR", options->against,
      "Pictures of an earlier run, as --out kept them: the page then shows the differences");
  command
      .add_option("--junit FILE", options->junit,
                  "Writes the results as JUnit XML, for CI services")
      .files(FileUse::writes);
  command
      .add_option("--report FILE", options->page,
                  "Writes a self-contained page of the differences, with pictures")
      .files(FileUse::page);
  add_run_options(command, options->scene);
  command.footer(
      "Renders each scene at the size and with the settings of its lock, and compares every "
      "channel; one line per\n"
      "scene. Exit status 0: all are equal; 1: something differs; else that of the first scene "
      "that could not be\n"
      "compared: no lock or changed inputs (3), an error in the scene (2) …. The other scenes are "
      "compared\n"
      "anyway.\n"
      "\n"
      "  belvedere verify scenes/*.toml --data ../data --junit verify.xml --report verify.html");
  return [options] { return run_verify(*options); };
}

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
      .add_option("--width PX", options->width,
                  "Width of the verified picture in pixels, its height in proportion. Default: as "
                  "in the existing lock, else 800, or the scene's if that is less")
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
