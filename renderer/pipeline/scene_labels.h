#pragma once

#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/labels/labels.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/world.h"
#include "terrain/io/features.h"

namespace belvedere {

// Files and settings of the labels of a picture, by paths.
struct LabelJob {
  std::vector<VectorSource> points, shapes, tracks;
  int summits = 0;  // of the DEM
  double min_prominence_m = 150.0;
  std::string style = "classic";  // built-in name or file
  std::vector<SceneNameByHand> by_hand = {};

  bool empty() const { return points.empty() && shapes.empty() && tracks.empty() && summits == 0; }
};

// The label job of a scene's [labels]; optional files that are missing are left out with a note.
LabelJob label_job(const LoadedScene& scene, Progress& progress);

// The style of a scene's names.
LabelStyle read_label_style(const LoadedScene& scene);

// Reads the files of a scene's [labels] and discards them, so that errors in them, or missing
// fonts, are reported before hours of work. Throws Error as make_label_sheet does.
void check_names(const LoadedScene& scene, const Dem& dem);

// Makes all names of the picture, located on its ground and placed on the whole sheet, whatever
// part of it is made. Throws Error(usage) where there is nothing to name, and, with both extents,
// where none of the files' points lies on the terrain.
LabelSheet make_label_sheet(const LoadedScene& scene, const LabelJob& job, const BareView& bare,
                            Progress& progress);

// Positions of the files' points in the picture, for places_csv: names are neither needed nor set,
// summits are not moved. Error(usage) with both extents where all lie outside the terrain.
LabelSheet locate_points(const std::vector<std::string>& files, const BareView& bare,
                         Progress& progress);

// Writes labels.svg, labels.csv, labels.geojson (where the terrain has a CRS), profile_N.svg and
// profile_N.png of each track. `under`: as for labels_svg.
void write_label_files(const LabelSheet& sheet, const std::string& crs, const std::string& folder,
                       const std::string& under, Progress& progress);

}  // namespace belvedere
