#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/run.h"
#include "renderer/image/image_file.h"
#include "renderer/labels/margin.h"
#include "renderer/pipeline/output_colour.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// Content of a margin's legend.
struct PictureLegend {
  std::vector<LegendEntry> classes;
  std::vector<FeatureSwatch> features;
};

// Rows [y0, y1) of the sheet over the region's width, encoded sRGB.
using SheetRows = std::function<Grid<glm::vec3>(int y0, int y1)>;

// Stem of the second picture of a scene: with names drawn in if [labels] has in_picture, in a
// margin if there is [margin]; empty without both, and for a part of the sheet that would show
// neither.
std::string second_picture(const Scene& scene, bool whole_sheet = true);

// Writes the results of [labels] and [margin] besides the panorama: labels.svg and the tables, and
// the second picture. A part of a sheet has no margin; its names are where the whole sheet has
// them.
void write_named_picture(const LoadedScene& loaded, PixelRect region, const SheetRows& rows,
                         const PictureLegend& legend, const OutputColour& colour,
                         const FileNotes& notes, const std::string& out_folder, const Run& run);

}  // namespace belvedere
