#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/run.h"
#include "renderer/image/image_file.h"
#include "renderer/labels/margin.h"
#include "renderer/pipeline/output_color.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// What the legend of a margin shows.
struct PictureLegend {
  std::vector<LegendEntry> classes;
  std::vector<FeatureSwatch> features;
};

// Rows [y0, y1) of the sheet over the region's width, encoded sRGB.
using SheetRows = std::function<Grid<glm::vec3>(int y0, int y1)>;

// Stem of the second picture that a scene asks for: with the names drawn in where [labels] has in_picture, in a [margin] where it has one;
// empty without both, and for a part of the sheet that would show neither.
std::string second_picture(const Scene& scene, bool whole_sheet = true);

// What [labels] and [margin] of a scene ask for beside the panorama: labels.svg and the tables, and the second picture. A part of a sheet
// has no margin; its names stand where the whole has them.
void write_named_picture(const LoadedScene& loaded, PixelRect region, const SheetRows& rows, const PictureLegend& legend,
                         const OutputColor& color, const FileNotes& notes, const std::string& out_folder, const Run& run);

}  // namespace belvedere
