#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/layers/fit/ground_fit.h"
#include "terrain/layers/fit/hue_saturation.h"

namespace belvedere {

// A region that somebody drew in the hue–saturation plane: the colours of one class.
struct ColourRegion {
  FitClass of;
  std::optional<bool> grey;                                    // only greys, or only what is none
  std::optional<std::array<double, 2>> hue_deg;                // from … up to, clockwise; over 360 where the first is larger
  std::array<double, 2> saturation = {0.0, 1.01};              // from … up to
  std::array<double, 2> value = {0.0, 1.01};                   // from … up to
  std::vector<std::array<double, 2>> polygon;                  // hue in degrees, saturation: corners in the plane; empty: none
  double lowest_m = -std::numeric_limits<double>::infinity();  // no lower than this: clouds are not snow
};
bool holds(const ColourRegion& region, const HueSaturation& colour, double altitude_m);

// [[region]] tables (docs/layers_fit.md); the first that holds a colour has it. Error(usage) with file:line:column.
std::vector<ColourRegion> parse_colour_regions(std::string_view text, const std::string& name);
std::vector<ColourRegion> read_colour_regions(const std::string& path);

}  // namespace belvedere
