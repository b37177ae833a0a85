#include "terrain/layers/fit/colour_regions.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <glm/common.hpp>

#include "base/config.h"
#include "base/error.h"
#include "base/masks/polygon.h"
#include "base/text/hex_colour.h"

namespace belvedere {
namespace {

std::array<double, 2> as_pair(const ConfigValue& value, const std::string& name, double lowest, double highest) {
  const ConfigArray& numbers = as_array(value, name);
  const std::string allowed = fmt::format("two numbers, {}…{}", lowest, highest);
  if (numbers.size() != 2)
    throw Error(ErrorKind::usage, config_where(name, value.place), fmt::format("{} values", numbers.size()), allowed);
  std::array<double, 2> pair{};
  for (std::size_t i = 0; i != 2; ++i) {
    pair[i] = as_number(numbers[i], name);
    if (!(pair[i] >= lowest && pair[i] <= highest))
      throw Error(ErrorKind::usage, config_where(name, numbers[i].place), describe(numbers[i]), allowed);
  }
  return pair;
}

// Even–odd rule in the plane, where saturation is the distance and hue the direction.
bool inside(const std::vector<std::array<double, 2>>& polygon, const HueSaturation& colour) {
  const auto place = [](double hue, double saturation) {
    const PlanePlace at = hue_saturation_place({hue, saturation, 1.0, false});
    return glm::dvec2(at.x, at.y);
  };
  std::vector<glm::dvec2> ring;
  for (const auto& [hue, saturation] : polygon) ring.push_back(place(hue, saturation));
  return encloses({ring}, place(colour.hue_deg, colour.saturation));
}

// The pixels of a picture of the plane that are painted in a colour, "#rrggbb". Painters' edges are soft: a pixel of less than a twelfth
// of the way to white or black away counts.
Grid<std::uint8_t> painted_in(const Grid<glm::vec3>& picture, const ConfigValue& colour, const std::string& name) {
  const std::string& text = as_string(colour, name);
  const std::optional<glm::vec3> wanted = colour_of_hex(text);
  if (!wanted) throw Error(ErrorKind::usage, config_where(name, colour.place), describe(colour), "a colour as \"#rrggbb\"");
  Grid<std::uint8_t> painted(picture.width(), picture.height());
  std::size_t count = 0;
  for (std::size_t i = 0; i != picture.size(); ++i) {
    const glm::vec3 away = glm::abs(picture[i] - *wanted);
    painted[i] = std::max({away.x, away.y, away.z}) < 1.F / 12.F ? 1 : 0;
    count += painted[i];
  }
  if (count == 0)
    throw Error(ErrorKind::usage, config_where(name, colour.place), fmt::format("no pixel of the picture is {}", text),
                "a colour that the plane is painted in");
  return painted;
}

ColourRegion region_of(const ConfigTable& table, ConfigPlace place, const std::string& name, const Grid<glm::vec3>& picture) {
  allow_only(table, {"name", "class", "colour", "grey", "hue_deg", "saturation", "value", "polygon", "lowest_m"}, name);
  ColourRegion region;
  const ConfigValue* title = find(table, "name");
  if (title == nullptr) throw Error(ErrorKind::usage, config_where(name, place), "a region without a name", "name = \"…\"");
  region.of.name = as_string(*title, name);
  if (const ConfigValue* painted_as = find(table, "class")) {
    const std::string& word = as_string(*painted_as, name);
    region.of.painted_as = find_class(word);
    if (!region.of.painted_as) {
      std::vector<std::string> known;
      for (const LandCoverClassInfo& info : land_cover_table) known.emplace_back(info.name);
      const std::string near = nearest_word(word, known);
      throw Error(ErrorKind::usage, config_where(name, painted_as->place), fmt::format("unknown class \"{}\"", word),
                  near.empty() ? "a class of docs/legends.md" : near);
    }
  }
  if (const ConfigValue* colour = find(table, "colour")) {
    if (picture.empty())
      throw Error(ErrorKind::usage, config_where(name, colour->place), "a colour, and no picture in which regions are painted",
                  "image = \"NAME.png\" above the regions");
    region.painted = painted_in(picture, *colour, name);
  }
  if (const ConfigValue* grey = find(table, "grey")) region.grey = as_bool(*grey, name);
  if (const ConfigValue* hue = find(table, "hue_deg")) region.hue_deg = as_pair(*hue, name, 0.0, 360.0);
  if (const ConfigValue* saturation = find(table, "saturation")) region.saturation = as_pair(*saturation, name, 0.0, 1.01);
  if (const ConfigValue* value = find(table, "value")) region.value = as_pair(*value, name, 0.0, 1.01);
  if (const ConfigValue* lowest = find(table, "lowest_m")) region.lowest_m = as_number(*lowest, name);
  if (const ConfigValue* polygon = find(table, "polygon")) {
    for (const ConfigValue& corner : as_array(*polygon, name)) {
      const ConfigArray& numbers = as_array(corner, name);
      if (numbers.size() != 2)
        throw Error(ErrorKind::usage, config_where(name, corner.place), "no corner", "[hue in degrees, saturation 0…1]");
      region.polygon.push_back({as_number(numbers[0], name), as_number(numbers[1], name)});
    }
    if (region.polygon.size() < 3)
      throw Error(ErrorKind::usage, config_where(name, polygon->place), fmt::format("{} corners", region.polygon.size()), "at least 3");
  }
  return region;
}

std::vector<ColourRegion> regions_of(const ConfigValue& root, const std::string& name, const PictureReader& read_picture) {
  const ConfigTable& table = as_table(root, name);
  allow_only(table, {"image", "region"}, name);
  std::vector<ColourRegion> regions;
  Grid<glm::vec3> picture;
  if (const ConfigValue* image = find(table, "image")) {
    const std::filesystem::path path = as_string(*image, name);
    if (!read_picture) throw Error(ErrorKind::bug, name, "regions are painted, and nobody reads pictures");
    picture = read_picture(path.is_absolute() ? path.string() : (std::filesystem::path(name).parent_path() / path).string());
  }
  if (const ConfigValue* list = find(table, "region"))
    for (const ConfigValue& value : as_array(*list, name)) regions.push_back(region_of(as_table(value, name), value.place, name, picture));
  // A name may come twice: a class of several regions.
  if (regions.empty()) throw Error(ErrorKind::usage, name, "no region", "[[region]] tables");
  return regions;
}

}  // namespace

bool holds(const ColourRegion& region, const HueSaturation& colour, double altitude_m) {
  if (region.grey && *region.grey != colour.grey) return false;
  if (altitude_m < region.lowest_m) return false;
  if (colour.saturation < region.saturation[0] || colour.saturation >= region.saturation[1]) return false;
  if (colour.value < region.value[0] || colour.value >= region.value[1]) return false;
  if (region.hue_deg) {
    const auto [from, to] = *region.hue_deg;
    const bool in = from <= to ? colour.hue_deg >= from && colour.hue_deg < to : colour.hue_deg >= from || colour.hue_deg < to;
    if (!in) return false;
  }
  if (!region.painted.empty()) {
    const PlanePixel at = plane_pixel(colour, region.painted.width(), region.painted.height());
    if (region.painted(at.x, at.y) == 0) return false;
  }
  return region.polygon.empty() || inside(region.polygon, colour);
}

PlanePixel plane_pixel(const HueSaturation& colour, int width, int height) {
  const PlanePlace at = hue_saturation_place(colour);
  return {std::clamp(static_cast<int>((0.5 + 0.5 * at.x) * width), 0, width - 1),
          std::clamp(static_cast<int>((0.5 - 0.5 * at.y) * height), 0, height - 1)};
}

std::vector<ColourRegion> parse_colour_regions(std::string_view text, const std::string& name, const PictureReader& read_picture) {
  return regions_of(parse_config(text, name), name, read_picture);
}
std::vector<ColourRegion> read_colour_regions(const std::string& path, const PictureReader& read_picture) {
  return regions_of(read_config(path), path, read_picture);
}

}  // namespace belvedere
