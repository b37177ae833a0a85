#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "renderer/compose/view_shape.h"

namespace belvedere::tools {

// Parsing of command-line values of `belvedere new`. All throw Error(usage) naming the option.

// "N", "northeast", "225": azimuth in degrees, 0…360.
double read_direction(const std::string& text);

// "LON,LAT", degrees.
glm::dvec2 read_lonlat(const std::string& option, const std::string& text);

// "NAME|LON,LAT" or "LON,LAT".
struct NamedPlace {
  std::string name;
  glm::dvec2 lonlat{0.0};
};
NamedPlace read_named_place(const std::string& text);

// The shape of the sheet and its width in print: "3:1", "A2" (landscape), "A2 upright", "1600x900"
// or "cylinder".
struct SheetFormat {
  ViewFormat picture;
  double sheet_width_mm = 1200.0;
  int width_px = 2400;
};
SheetFormat read_format(const std::string& text);

}  // namespace belvedere::tools
