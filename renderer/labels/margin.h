#pragma once

#include <array>
#include <string>
#include <vector>

#include "renderer/labels/drawing.h"
#include "renderer/labels/label_style.h"
#include "renderer/labels/legend_swatch.h"
#include "renderer/trace/geo_map.h"

namespace belvedere {

struct LegendEntry {
  std::string name;
  std::string colour;  // "#rrggbb"
};

// The size of a length across the line of sight in the picture.
struct ScaleBar {
  double distance_m = 0.0;  // from the eye
  double px_per_m = 0.0;
};

// The texts beside a picture. Empty ones are left out.
struct MarginContent {
  std::string title;
  std::string subtitle;
  std::vector<LegendEntry> classes;
  std::vector<FeatureSwatch> features;  // roads, runs and the like, after the classes
  std::vector<ScaleBar> scales;         // near ones first
  bool directions = false;              // with these three, degrees clockwise from north
  double view_azimuth_deg = 0.0;
  double sun_azimuth_deg = 0.0;
  double sun_altitude_deg = 0.0;
  std::vector<std::string> sources;
};

// Paper around a picture, whole pixels of it on each side, and the drawing on the resulting sheet.
struct Margin {
  int left = 0, top = 0, right = 0, bottom = 0;
  Drawing drawing;  // x, y from the corner of the paper; the picture begins at (left, top)
};

// Lays out title, legend, scales and directions side by side in a strip below the picture, in
// several rows where it is narrow, and the sources below. px_per_mm as of LabelSheet; frame_px:
// paper on each side.
Margin lay_out_margin(const MarginContent& content, const MarginStyle& style, glm::ivec2 picture_px,
                      double px_per_mm, double frame_px);

// The scale across the picture in its central column at the ground low in the picture, and at the
// ground a seventh of the distance from the skyline down to it; fewer where there is no ground.
std::vector<ScaleBar> find_scales(const GeoMap& map, glm::dvec2 eye, double skyline_px,
                                  glm::ivec2 size_px);

// The largest round length (1, 2 or 5 times a power of ten) whose bar fits, m.
double bar_length_m(double px_per_m, double max_px);

// "10 km", "500 m".
std::string length_text(double length_m);

}  // namespace belvedere
