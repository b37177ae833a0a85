#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/labels/labels.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/valley_view.h"

namespace belvedere {

// What is to be named in a picture, by paths.
struct LabelJob {
  std::vector<std::string> points, shapes, tracks;
  int summits = 0;  // of the DEM
  double least_prominence_m = 150.0;
  std::string style = "classic";  // built-in name or file

  bool empty() const { return points.empty() && shapes.empty() && tracks.empty() && summits == 0; }
};

// That of a scene's [labels]; optional files that are missing are left out with a note.
LabelJob label_job(const LoadedScene& scene, Progress& progress);

// Reads the files of a scene's [labels] and forgets them: what is wrong with them, or that there are no fonts, is said before
// hours of work. Throws Error as make_label_sheet does.
void check_names(const LoadedScene& scene, const Dem& dem);

// All names of the picture, found on its ground and placed on the whole sheet whatever part of it is made. Throws Error(usage) where there
// is nothing to name, and where none of the files' places lies on the terrain: with both extents.
LabelSheet make_label_sheet(const LoadedScene& scene, const LabelJob& job, const BareView& bare, Progress& progress);

// Where the points of files stand in the picture, exactly where the files have them, for places_csv: no name is needed, none is set,
// summits are not climbed. Error(usage) with both extents where all lie outside of the terrain.
LabelSheet locate_points(const std::vector<std::string>& files, const BareView& bare, Progress& progress);

// labels.svg, labels.csv, labels.geojson (where the terrain has a CRS), profile_N.svg and profile_N.png of each track. `under`: as of
// labels_svg.
void write_label_files(const LabelSheet& sheet, const std::string& crs, const std::string& folder, const std::string& under,
                       Progress& progress);

}  // namespace belvedere
