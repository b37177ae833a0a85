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

// Classes that a picture shows, as the work folder keeps them: "rock #a0a0a0" a line.
std::string legend_to_text(const std::vector<LegendEntry>& legend);
std::vector<LegendEntry> legend_from_text(const std::string& text);

// Rows [y0, y1) of the sheet over the region's width, encoded sRGB.
using SheetRows = std::function<Grid<glm::vec3>(int y0, int y1)>;

// What [labels] and [margin] of a scene ask for beside the panorama: labels.svg and the tables, and with in_picture, or a margin, the
// second picture panorama_names. A part of a sheet has no margin; its names stand where the whole has them.
void write_named_picture(const LoadedScene& loaded, PixelRect region, const SheetRows& rows, const std::vector<LegendEntry>& classes,
                         const OutputColor& color, const FileNotes& notes, const std::string& out_folder, const Run& run);

}  // namespace belvedere
