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

// How the scene names its files, which must lie beside it or in a --data folder.
class SceneFileNames {
 public:
  explicit SceneFileNames(const NewOptions& options);
  // The scene's word for a file, whose folder becomes one of data() where the scene has to be told.
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

// The elevation of the region: the files of the command line or, with --at, what is fetched for it, with its land cover. `about` becomes
// what the scene says of them. Throws Error(input) for files that are not there or do not say where they lie, and what fetch_area throws.
DemParameters find_elevation(const NewOptions& options, SceneFileNames& names, const Cache& cache, Progress& progress,
                             ProposedScene& about);

// The user's own land cover: what he says of the file is held against it, so that a wrong band or place is found before anything is drawn.
// Throws Error(input) for a file that is not there, does not say where it lies, or lies elsewhere than the ground.
void find_land_cover(const NewOptions& options, SceneFileNames& names, const CoarseGround& ground, Progress& progress,
                     ProposedScene& about);

}  // namespace belvedere::tools
