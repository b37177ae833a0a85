#pragma once

#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/proposed_scene.h"
#include "terrain/io/dem.h"
#include "tools/cli/new/new_options.h"

namespace belvedere::tools {

// Names of the scene's files, which must be beside it or in a --data folder.
class SceneFileNames {
 public:
  explicit SceneFileNames(const NewOptions& options);
  // The scene's name for a file; its folder is added to data() if the scene needs it.
  std::string name(const std::string& path);
  // The folders that rendering needs as --data.
  const std::vector<std::string>& data() const { return data_; }
  // The scene's own.
  const std::string& folder() const { return folder_; }

 private:
  std::string keep(const std::string& folder, const std::string& name);

  std::string folder_;
  std::vector<std::string> given_;
  std::vector<std::string> data_;
};

// Checks before any work that the files that options name exist, and that style and legend are
// such.
void check_files(const NewOptions& options);

// Path of the style file that the scene names, or its built-in name.
std::string find_style(const NewOptions& options, SceneFileNames& names);

// The elevation of the region: the files of the command line or, with --at, what is fetched for it,
// with its land cover. `about` receives the scene's keys for them. Throws Error(input) for files
// that do not exist or are not georeferenced, and the errors of fetch_area.
DemParameters find_elevation(const NewOptions& options, SceneFileNames& names, const Cache& cache,
                             Progress& progress, ProposedScene& about);

// The user's own land cover: his description of the file is checked against it, so that a wrong
// band or position is found before rendering. Throws Error(input) for a file that does not exist,
// is not georeferenced, or does not overlap the ground.
void find_land_cover(const NewOptions& options, SceneFileNames& names, const CoarseGround& ground,
                     Progress& progress, ProposedScene& about);

}  // namespace belvedere::tools
