#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "renderer/scene/scene.h"

namespace belvedere {

class KeptFiles;  // base/files/kept_files.h
std::shared_ptr<KeptFiles> make_kept_files();

struct SceneFileOptions {
  std::vector<std::string> data_folders;  // --data: further folders files may come from
  std::vector<std::string> settings;      // --set key.path=value, in order
};

// A scene and how its files were found.
struct LoadedScene {
  Scene scene;                               // file names as written
  std::string folder;                        // of the scene file
  std::string name;                          // file name without extension
  std::vector<std::string> allowed_folders;  // the scene's folder first, then the --data folders,
                                             // in their order; some may not exist
  std::shared_ptr<KeptFiles> kept = make_kept_files();  // what was read of its files
};

// TOML to Scene, strict. Error(usage) for an unknown key, a wrong type, a value out of range, keys
// that exclude each other, or a file outside the allowed folders, with file:line:column (or --set
// …), the value found, what is allowed and the nearest known key.
LoadedScene read_scene(const std::string& path, const SceneFileOptions& options);
// The same from text (the embedded demo, tests).
LoadedScene parse_scene(const std::string& text, const std::string& name, const std::string& folder,
                        const SceneFileOptions& options);

// A file that a scene names.
struct SceneInput {
  std::string key;   // "terrain.sources.0.file"
  std::string file;  // as written
  std::string path;  // where it was found; empty where it is missing
  std::string origin;
  std::string licence;
  std::string get_from;
  bool optional = false;
};
// All of them, in the order of the reference. Built-in palettes, legends and rules are not files.
std::vector<SceneInput> scene_inputs(const LoadedScene& scene);
// Tells file_guard() of them, with all that a virtual raster is read from, so that no result
// replaces one in this process.
void guard_inputs(const LoadedScene& scene);
// Credits of the data: "origin (licence)", each once, in the order of the inputs.
std::vector<std::string> source_credits(const LoadedScene& scene);

// The path of a file that a scene names, searched beside the scene, then in each data folder.
// Error(usage) where it leaves the allowed folders, also through a link; an empty string where it
// does not exist.
std::string find_scene_file(const LoadedScene& scene, const std::string& file);
// A hint at a file of a similar name where find_scene_file finds nothing, as similar_path_hint.
std::string similar_scene_file_hint(const LoadedScene& scene, const std::string& file);
// Error(input) for a file of the scene that does not exist.
Error missing_scene_file(const LoadedScene& scene, const std::string& file);
// As find_scene_file for a name that may also be built in (palette, legend, rules): built-in names
// are returned unchanged. folder: "palettes", "legends", "layers". Error(input) where the file does
// not exist.
std::string find_named_file(const LoadedScene& scene, const std::string& folder,
                            const std::string& name_or_file);
// Lists all files that the scene needs and that are missing, with origin and where to get them, in
// one Error(input). Optional files may be missing.
void require_scene_files(const LoadedScene& scene);

// The whole scene with all defaults as TOML; reads back to the same scene.
std::string write_scene(const Scene& scene);
// JSON Schema, draft 4, from the same table that validates.
std::string scene_json_schema();
// The reference of all keys as Markdown (docs/scene.md is made from it and a test compares).
std::string scene_reference();

}  // namespace belvedere
