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
#include "terrain/layers/fit/fit_measures.h"
#include "terrain/layers/fit/ground_fit.h"

namespace belvedere {

// A user-defined region of the hue–saturation plane: the colours of one class.
struct ColourRegion {
  FitClass of;
  std::optional<bool> grey;           // true: only greys; false: no greys
  std::optional<glm::dvec2> hue_deg;  // range, clockwise; across 360 if the first is larger
  glm::dvec2 saturation{0.0, 1.01};   // from … below
  glm::dvec2 value{0.0, 1.01};        // from … below
  std::vector<glm::dvec2> polygon;  // hue in degrees, saturation: corners in the plane; empty: none
  double lowest_m = -std::numeric_limits<double>::infinity();  // minimum altitude, for example to
                                                               // separate snow from clouds
  Grid<std::uint8_t> painted;  // 1 where the region is painted in a picture of the plane
                               // (plane_pixel); empty: not painted
};
// Position of a colour in a picture of the plane, as in reports: grey at the centre, red to the
// right, green to the upper left.
struct PlanePixel {
  int x = 0;
  int y = 0;
};
PlanePixel plane_pixel(const HueSaturation& colour, int width, int height);
bool holds(const ColourRegion& region, const HueSaturation& colour, double altitude_m);

// Reads a picture that a file of regions refers to, encoded sRGB 0…1; throws Error(input).
using PictureReader = std::function<Grid<glm::vec3>(const std::string& path)>;

// [[region]] tables (docs/layers_fit.md); the first region that contains a colour takes it.
// Error(usage) with file:line:column. The picture of painted regions is relative to the file.
std::vector<ColourRegion> parse_colour_regions(std::string_view text, const std::string& name,
                                               const PictureReader& read_picture = {});
std::vector<ColourRegion> read_colour_regions(const std::string& path,
                                              const PictureReader& read_picture = {});

}  // namespace belvedere
