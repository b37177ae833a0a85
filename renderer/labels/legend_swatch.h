#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "renderer/labels/drawing.h"

namespace belvedere {

// Legend symbols of kinds of features.
enum class SwatchForm : int { line, cable, house };

// A kind of features for a legend. Colours "#rrggbb", empty: none; lengths in mm of the sheet, as
// in the foreground.
struct FeatureSwatch {
  std::string name;
  SwatchForm form = SwatchForm::line;
  std::string ground = "#c8cfa4";  // ground below it; empty: a piece of the picture
  std::string fill = "#f2e7cb";
  std::string casing = "#6b4a33";
  std::string bed = {};
  double width_mm = 0.6;    // of the fill, 0…50
  double min_px = 0.0;      // never narrower, 0…100
  double casing_mm = 0.14;  // of each edge, 0…10
  double bed_mm = 0.0;      // beyond the fill on each side, 0…50
  double opacity = 1.0;     // of fill and casing, 0…1
  glm::dvec2 dash_mm{0.0};  // of the fill: on and off; 0, 0: solid
  bool has_pylons = false;  // below a cable
};

// A short piece of it on its ground, in a box of that size whose corner is (0, 0), without a frame.
// Features wider than the box, such as ski runs of a small sheet, are drawn narrower.
std::vector<DrawnShape> draw_swatch(const FeatureSwatch& swatch, glm::dvec2 size_px,
                                    double px_per_mm);

}  // namespace belvedere
