#pragma once

#include <vector>

#include "renderer/labels/drawing.h"
#include "renderer/labels/label_style.h"
#include "renderer/labels/margin_blocks.h"
#include "renderer/trace/geo_map.h"

namespace belvedere {

// Paper around a picture, whole pixels of it on each side, and the drawing on the resulting sheet.
struct Margin {
  int left = 0, top = 0, right = 0, bottom = 0;
  Drawing drawing;  // x, y from the corner of the paper; the picture begins at (left, top)
  std::vector<LegendCrop> crops = {};
};

// Lays out title, legend, scales and directions side by side in a strip below the picture, in
// several rows where it is narrow, and the sources below a rule; a double line frames the picture.
// px_per_mm as of LabelSheet; frame_px: paper on each side.
Margin lay_out_margin(const MarginContent& content, const MarginStyle& style, glm::ivec2 picture_px,
                      double px_per_mm, double frame_px);

// The scale across the picture in its central column at the ground low in the picture, and at the
// ground a seventh of the distance from the skyline down to it; fewer where there is no ground.
std::vector<ScaleBar> find_scales(const GeoMap& map, glm::dvec2 eye, double skyline_px,
                                  glm::ivec2 size_px);

}  // namespace belvedere
