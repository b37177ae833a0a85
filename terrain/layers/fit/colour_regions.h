#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/grid.h"
#include "terrain/layers/fit/ground_fit.h"
#include "terrain/layers/fit/hue_saturation.h"

namespace belvedere {

// A region that somebody drew in the hue–saturation plane: the colours of one class.
struct ColourRegion {
  FitClass of;
  std::optional<bool> grey;                                    // only greys, or only what is none
  std::optional<glm::dvec2> hue_deg;                           // from … up to, clockwise; over 360 where the first is larger
  glm::dvec2 saturation{0.0, 1.01};                            // from … up to
  glm::dvec2 value{0.0, 1.01};                                 // from … up to
  std::vector<glm::dvec2> polygon;                             // hue in degrees, saturation: corners in the plane; empty: none
  double lowest_m = -std::numeric_limits<double>::infinity();  // no lower than this: clouds are not snow
  Grid<std::uint8_t> painted;  // 1 where the region is painted in a picture of the plane (plane_pixel); empty: not painted
};
// Where a colour lies in a picture of the plane, as a report draws it: the middle is grey, red to the right, green upwards to the left.
struct PlanePixel {
  int x = 0;
  int y = 0;
};
PlanePixel plane_pixel(const HueSaturation& colour, int width, int height);
bool holds(const ColourRegion& region, const HueSaturation& colour, double altitude_m);

// A picture of a path that a file of regions names, encoded sRGB 0…1; throws Error(input).
using PictureReader = std::function<Grid<glm::vec3>(const std::string& path)>;

// [[region]] tables (docs/layers_fit.md); the first that holds a colour has it. Error(usage) with file:line:column. Where regions are
// painted, the picture lies beside the file.
std::vector<ColourRegion> parse_colour_regions(std::string_view text, const std::string& name, const PictureReader& read_picture = {});
std::vector<ColourRegion> read_colour_regions(const std::string& path, const PictureReader& read_picture = {});

}  // namespace belvedere
