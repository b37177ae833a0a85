#include "terrain/layers/fit/colour_regions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <glm/common.hpp>

#include "base/config.h"
#include "base/error.h"
#include "base/masks/polygon.h"
#include "base/text/config_reader.h"
#include "terrain/cover/layer_inputs.h"

namespace belvedere {
namespace {

// Even–odd rule in the plane; polar coordinates with saturation as radius and hue as angle.
bool inside(const std::vector<glm::dvec2>& polygon, const HueSaturation& colour) {
  const auto position = [](double hue, double saturation) {
    const PlanePosition at = hue_saturation_place({hue, saturation, 1.0, false});
    return glm::dvec2(at.x, at.y);
  };
  std::vector<glm::dvec2> ring;
  for (const glm::dvec2& corner : polygon) ring.push_back(position(corner.x, corner.y));
  return encloses({ring}, position(colour.hue_deg, colour.saturation));
}

// The pixels of a picture of the plane that are painted in a colour. Edges may be antialiased: a
// tolerance of a twelfth of the range applies.
Grid<std::uint8_t> painted_in(const Grid<glm::vec3>& picture, const glm::vec3& wanted) {
  Grid<std::uint8_t> painted(picture.width(), picture.height());
  for (std::size_t i = 0; i != picture.size(); ++i) {
    const glm::vec3 away = glm::abs(picture[i] - wanted);
    painted[i] = std::max({away.x, away.y, away.z}) < 1.F / 12.F ? 1 : 0;
  }
  return painted;
}

ColourRegion region_of(const ConfigValue& table, const std::string& name,
                       const Grid<glm::vec3>& picture) {
  ConfigReader reader(table, name);
  ColourRegion region;
  reader.text("name", region.of.name);
  if (region.of.name.empty()) refuse_value(table, name, "region without a name", "name = \"…\"");
  if (const ConfigValue* painted_as = reader.known("class"))
    region.of.painted_as = as_ground_class(*painted_as, name);
  if (const ConfigValue* colour = reader.known("colour")) {
    if (picture.empty())
      refuse_value(*colour, name, "colour without a picture of painted regions",
                   "image = \"NAME.png\" before the regions");
    glm::vec3 wanted{};
    reader.colour("colour", wanted);
    region.painted = painted_in(picture, wanted);
    if (std::count(region.painted.begin(), region.painted.end(), 1) == 0)
      refuse_value(*colour, name, "the picture has no pixels of colour " + as_string(*colour, name),
                   "a colour of the picture");
  }
  if (reader.known("shown") != nullptr) {
    glm::vec3 shown{};
    reader.colour("shown", shown);
    region.of.shown = 255.F * shown;
  }
  if (const ConfigValue* grey = reader.known("grey")) region.grey = as_bool(*grey, name);
  glm::dvec2 hue_deg(-1.0);
  reader.pair("hue_deg", hue_deg, 0.0, 360.0);
  if (hue_deg.x >= 0.0) region.hue_deg = hue_deg;
  reader.pair("saturation", region.saturation, 0.0, 1.01);
  reader.pair("value", region.value, 0.0, 1.01);
  if (const ConfigValue* lowest = reader.known("lowest_m"))
    region.lowest_m = as_number(*lowest, name);
  if (const ConfigValue* polygon = reader.known("polygon")) {
    for (const ConfigValue& corner : as_array(*polygon, name)) {
      const ConfigArray& numbers = as_array(corner, name);
      if (numbers.size() != 2)
        refuse_value(corner, name, "invalid corner", "[hue in degrees, saturation 0…1]");
      region.polygon.emplace_back(as_number(numbers[0], name), as_number(numbers[1], name));
    }
    if (region.polygon.size() < 3)
      refuse_value(*polygon, name, fmt::format("{} corners", region.polygon.size()),
                   "at least 3 corners");
  }
  reader.end();
  return region;
}

std::vector<ColourRegion> regions_of(const ConfigValue& root, const std::string& name,
                                     const PictureReader& read_picture) {
  const ConfigTable& table = as_table(root, name);
  allow_only(table, {"image", "region"}, name);
  std::vector<ColourRegion> regions;
  Grid<glm::vec3> picture;
  if (const ConfigValue* image = find(table, "image")) {
    const std::filesystem::path path = as_string(*image, name);
    if (!read_picture)
      throw Error(ErrorKind::bug, name, "painted regions without a picture reader");
    picture = read_picture(path.is_absolute()
                               ? path.string()
                               : (std::filesystem::path(name).parent_path() / path).string());
  }
  if (const ConfigValue* list = find(table, "region"))
    for (const ConfigValue& value : as_array(*list, name))
      regions.push_back(region_of(value, name, picture));
  // A name may occur twice: a class of several regions.
  if (regions.empty()) throw Error(ErrorKind::usage, name, "no regions", "[[region]] tables");
  return regions;
}

}  // namespace

bool holds(const ColourRegion& region, const HueSaturation& colour, double altitude_m) {
  if (region.grey && *region.grey != colour.grey) return false;
  if (altitude_m < region.lowest_m) return false;
  if (colour.saturation < region.saturation.x || colour.saturation >= region.saturation.y)
    return false;
  if (colour.value < region.value.x || colour.value >= region.value.y) return false;
  if (region.hue_deg) {
    const double from = region.hue_deg->x;
    const double to = region.hue_deg->y;
    const bool in = from <= to ? colour.hue_deg >= from && colour.hue_deg < to
                               : colour.hue_deg >= from || colour.hue_deg < to;
    if (!in) return false;
  }
  if (!region.painted.empty()) {
    const PlanePixel at = plane_pixel(colour, region.painted.width(), region.painted.height());
    if (region.painted(at.x, at.y) == 0) return false;
  }
  return region.polygon.empty() || inside(region.polygon, colour);
}

PlanePixel plane_pixel(const HueSaturation& colour, int width, int height) {
  const PlanePosition at = hue_saturation_place(colour);
  return {std::clamp(static_cast<int>((0.5 + 0.5 * at.x) * width), 0, width - 1),
          std::clamp(static_cast<int>((0.5 - 0.5 * at.y) * height), 0, height - 1)};
}

std::vector<ColourRegion> parse_colour_regions(std::string_view text, const std::string& name,
                                               const PictureReader& read_picture) {
  return regions_of(parse_config(text, name), name, read_picture);
}
std::vector<ColourRegion> read_colour_regions(const std::string& path,
                                              const PictureReader& read_picture) {
  return regions_of(read_config(path), path, read_picture);
}

}  // namespace belvedere
