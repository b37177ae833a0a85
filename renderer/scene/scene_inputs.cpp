#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/text/embedded.h"
#include "base/text/missing_file.h"
#include "renderer/scene/scene_file.h"
#include "renderer/scene/scene_schema.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

// The path with all links resolved as far as it exists; empty where that fails (a loop of links, no
// permission).
fs::path resolved(const fs::path& path) {
  std::error_code problem;
  fs::path out = fs::weakly_canonical(fs::absolute(path), problem);
  return problem ? fs::path() : out;
}

bool is_inside(const fs::path& path, const fs::path& folder) {
  const auto [at_folder, at_path] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  // A folder's name with a slash after it ends in an empty part.
  return at_folder == folder.end() || (at_folder->empty() && std::next(at_folder) == folder.end());
}

const std::string& text_at(const SceneSection& section, std::string_view name, Scene& scene,
                           std::size_t i) {
  static const std::string none;
  const SceneKey* key = find_key(section, name);
  return key == nullptr ? none : *std::get<std::string*>(key->field(scene, i));
}

}  // namespace

std::string find_scene_file(const LoadedScene& scene, const std::string& file) {
  const auto refuse = [&](const std::string& found) {
    const bool printable =
        std::none_of(file.begin(), file.end(), [](unsigned char c) { return c < 0x20; });
    throw Error(ErrorKind::usage, printable ? file : scene.name, found,
                fmt::format("files in {} (add folders with --data)",
                            fmt::join(scene.allowed_folders, ", ")));
  };
  if (file.empty()) return {};
  if (std::any_of(file.begin(), file.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
    refuse("the file's name contains control characters");
  if (is_address(file)) {
    check_address(file);
    if (http_allowed()) return file;
    throw Error(ErrorKind::usage, file,
                "the file is on a server, and access to servers is not allowed",
                "--allow-http, or a local copy of the file");
  }
  std::vector<fs::path> folders;
  for (const std::string& folder : scene.allowed_folders)
    folders.push_back(resolved(folder.empty() ? "." : folder));
  const auto allowed = [&](const fs::path& path) {
    return !path.empty() &&
           std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
             return !folder.empty() && is_inside(path, folder);
           });
  };
  // A name that leaves one folder may still lie in another, so all are tried before it is refused.
  bool outside = false;
  for (const fs::path& folder : folders) {
    if (folder.empty()) continue;
    const fs::path candidate = resolved(folder / file);  // an absolute `file` stays as it is
    std::error_code ignored;
    if (!allowed(candidate)) {
      outside = true;
    } else if (fs::exists(candidate, ignored)) {
      return candidate.string();
    }
  }
  if (outside) refuse("the file lies outside the scene's folder and the --data folders");
  return {};
}

std::string similar_scene_file_hint(const LoadedScene& scene, const std::string& file) {
  for (const std::string& folder : scene.allowed_folders)
    if (std::string hint = similar_path_hint((fs::path(folder) / file).string()); !hint.empty())
      return hint;
  return {};
}

Error missing_scene_file(const LoadedScene& scene, const std::string& file) {
  return {ErrorKind::input, file, "file not found" + similar_scene_file_hint(scene, file),
          "a file beside the scene file, or in a folder given with --data"};
}

std::string find_named_file(const LoadedScene& scene, const std::string& folder,
                            const std::string& name_or_file) {
  const std::vector<std::string> built_in = embedded_names(folder);
  if (name_or_file.empty() ||
      std::find(built_in.begin(), built_in.end(), name_or_file) != built_in.end())
    return name_or_file;
  std::string path = find_scene_file(scene, name_or_file);
  if (path.empty())
    throw Error(ErrorKind::input, name_or_file,
                "file not found, and there is no built-in one of that name" +
                    similar_scene_file_hint(scene, name_or_file),
                fmt::format("{}, or a file", fmt::join(built_in, ", ")));
  return path;
}

std::vector<SceneInput> scene_inputs(const LoadedScene& scene) {
  std::vector<SceneInput> inputs;
  Scene values = scene.scene;  // the table's accessors need one to write to
  for (const SceneSection& section : scene_sections()) {
    const std::size_t count = section.count == nullptr ? 1 : section.count(values);
    const SceneKey* enabled =
        section.kind == SectionKind::list ? find_key(section, "enabled") : nullptr;
    for (std::size_t i = 0; i < count; ++i) {
      if (enabled != nullptr && !*std::get<bool*>(enabled->field(values, i))) continue;
      const std::string element = section.kind == SectionKind::list
                                      ? join_key(section.name, std::to_string(i))
                                      : std::string(section.name);
      for (const SceneKey& key : section.keys) {
        if (key.text != TextKind::file && key.text != TextKind::built_in) continue;
        const std::string& file = *std::get<std::string*>(key.field(values, i));
        const std::vector<std::string> built_in = key.text == TextKind::built_in
                                                      ? embedded_names(key.choices_from)
                                                      : std::vector<std::string>();
        if (file.empty() || std::find(built_in.begin(), built_in.end(), file) != built_in.end())
          continue;
        const SceneKey* optional = find_key(section, "optional");
        inputs.push_back(
            {.key = join_key(element, key.name),
             .file = file,
             .path = find_scene_file(scene, file),
             .origin = text_at(section, "origin", values, i),
             .licence = text_at(section, "licence", values, i),
             .get_from = text_at(section, "get_from", values, i),
             .optional = optional != nullptr && *std::get<bool*>(optional->field(values, i))});
      }
    }
  }
  return inputs;
}

void guard_inputs(const LoadedScene& scene) {
  for (const SceneInput& input : scene_inputs(scene)) {
    if (input.path.empty()) continue;
    file_guard().reads(input.path, input.key);
    if (!input.path.ends_with(".vrt")) continue;
    for (const std::string& part : raster_parts(input.path)) file_guard().reads(part, input.key);
  }
}

std::vector<std::string> source_credits(const LoadedScene& scene) {
  std::vector<std::string> credits;
  for (const SceneInput& input : scene_inputs(scene)) {
    if (input.origin.empty()) continue;
    const std::string credit =
        input.licence.empty() ? input.origin : input.origin + " (" + input.licence + ")";
    if (std::find(credits.begin(), credits.end(), credit) == credits.end())
      credits.push_back(credit);
  }
  return credits;
}

void require_scene_files(const LoadedScene& scene) {
  std::string list;
  int missing = 0;
  for (const SceneInput& input : scene_inputs(scene)) {
    if (!input.path.empty() || input.optional) continue;
    ++missing;
    list += fmt::format("\n  {} ({}){}", input.file, input.key,
                        similar_scene_file_hint(scene, input.file));
    if (!input.origin.empty())
      list +=
          "\n"
          "    origin: " +
          input.origin;
    if (!input.licence.empty()) list += "\n    licence: " + input.licence;
    if (!input.get_from.empty()) list += "\n    get it from: " + input.get_from;
  }
  if (missing == 0) return;
  std::string looked;
  for (const std::string& folder : scene.allowed_folders) {
    std::error_code ignored;
    looked += fmt::format("{}{}{}", looked.empty() ? "" : ", ", folder.empty() ? "." : folder,
                          fs::is_directory(folder.empty() ? "." : folder, ignored)
                              ? ""
                              : " (there is no such folder)");
  }
  throw Error(ErrorKind::input, scene.name,
              fmt::format("{} that the scene needs {} missing:{}\n  looked in: {}",
                          missing == 1 ? "a file" : fmt::format("{} files", missing),
                          missing == 1 ? "is" : "are", list, looked),
              "files beside the scene file, or in a folder given with --data");
}

}  // namespace belvedere
