#include "renderer/scene/scene_schema.h"

#include <fmt/format.h>

#include "base/text/embedded.h"

namespace belvedere {
namespace {

std::string number(double value) { return fmt::format("{}", value); }

}  // namespace

const std::vector<SceneSection>& scene_sections() {
  static const std::vector<SceneSection> sections = make_scene_sections();
  return sections;
}

const std::vector<SceneExclusion>& scene_exclusions() {
  static const std::vector<SceneExclusion> exclusions = {
      {"camera", {"position"}, {"position_lonlat"}},
      {"camera", {"look_at"}, {"look_at_lonlat"}},
      {"camera", {"look_at", "look_at_lonlat"}, {"azimuth_deg", "pitch_deg"}},
      {"deform.bend.points", {"drop_m"}, {"inclination_deg"}},
      {"land_cover.towns", {"position"}, {"position_lonlat"}},
      {"deform.summits", {"position"}, {"position_lonlat"}},
      {"deform.handles", {"position"}, {"position_lonlat"}},
      {"deform.field.places", {"position"}, {"position_lonlat"}},
      {"air.mist", {"position"}, {"position_lonlat"}},
      {"light.regions", {"position"}, {"position_lonlat", "points", "points_lonlat", "file"}},
      {"light.regions", {"position_lonlat"}, {"points", "points_lonlat", "file"}},
      {"light.regions", {"points"}, {"points_lonlat", "file", "radius_m"}},
      {"light.regions", {"points_lonlat"}, {"file", "radius_m"}},
      {"light.regions", {"file"}, {"radius_m"}},
      {"light.regions", {"azimuth_deg"}, {"turn_deg"}},
      {"light.clouds", {"position"}, {"position_lonlat"}},
      {"sun", {"time"}, {"azimuth_deg", "altitude_deg"}},
      {"exemplar", {"guidance"}, {"altitude", "altitude_range_m", "distance", "distance_range_m"}},
      {"exemplar", {"picture"}, {"width", "height", "seed"}},
  };
  return exclusions;
}

const SceneSection* find_section(std::string_view name) {
  for (const SceneSection& section : scene_sections())
    if (section.name == name) return &section;
  return nullptr;
}

const SceneKey* find_key(const SceneSection& section, std::string_view name) {
  for (const SceneKey& key : section.keys)
    if (key.name == name) return &key;
  return nullptr;
}

std::vector<const SceneSection*> child_sections(std::string_view parent) {
  std::vector<const SceneSection*> children;
  for (const SceneSection& section : scene_sections()) {
    const std::size_t dot = section.name.rfind('.');
    const std::string_view above =
        dot == std::string_view::npos ? std::string_view() : section.name.substr(0, dot);
    if (!section.name.empty() && above == parent) children.push_back(&section);
  }
  return children;
}

std::string join_key(std::string_view section, std::string_view key) {
  return section.empty() ? std::string(key) : fmt::format("{}.{}", section, key);
}

std::string describe_range(const SceneKey& key) {
  if (key.lonlat) return "longitude -180 … 180°, latitude -90 … 90°";
  const SceneRange& range = key.range;
  const std::string unit = key.unit.empty()  ? ""
                           : key.unit == "°" ? "°"
                                             : " " + std::string(key.unit);
  if (range.min == range.max) return number(range.min) + unit;
  if (range.above_min)
    return fmt::format("more than {}, at most {}{}", number(range.min), number(range.max), unit);
  const bool bounded = range.min > -std::numeric_limits<double>::infinity() &&
                       range.max < std::numeric_limits<double>::infinity();
  return bounded ? fmt::format("{} … {}{}", number(range.min), number(range.max), unit)
                 : std::string();
}

std::vector<std::string> key_choices(const SceneKey& key) {
  return key.text == TextKind::built_in ? embedded_names(key.choices_from) : key.choices;
}

std::string describe_type(const SceneKey& key) {
  struct Visitor {
    const SceneKey& key;
    std::string operator()(bool*) const { return "true or false"; }
    std::string operator()(std::optional<bool>*) const { return "true, false or \"auto\""; }
    std::string operator()(int*) const { return "a whole number"; }
    std::string operator()(std::uint64_t*) const { return "a whole number"; }
    std::string operator()(double*) const { return "a number"; }
    std::string operator()(float*) const { return "a number"; }
    std::string operator()(std::optional<double>*) const {
      return key.derived.empty() ? "a number" : "a number or \"auto\"";
    }
    std::string operator()(std::optional<glm::dvec2>*) const {
      return key.lonlat ? "two numbers, [longitude, latitude]" : "two numbers, [E, N]";
    }
    std::string operator()(std::array<double, 2>*) const { return "two numbers, [lower, upper]"; }
    std::string operator()(std::optional<std::array<double, 4>>*) const {
      return "four numbers, [min E, min N, max E, max N]";
    }
    std::string operator()(std::vector<glm::dvec2>*) const {
      return key.lonlat ? "three positions or more, [[longitude, latitude], …]"
                        : "three positions or more, [[E, N], …]";
    }
    std::string operator()(std::vector<float>*) const { return "1 to 12 numbers, [a, b, …]"; }
    std::string operator()(std::optional<LandCoverClass>*) const { return "a class name"; }
    std::string operator()(std::vector<LandCoverClass>*) const { return "a list of class names"; }
    std::string operator()(std::vector<std::string>*) const {
      return fmt::format("a list of {}", fmt::join(key_choices(key), ", "));
    }
    std::string operator()(std::vector<std::pair<std::string, double>>*) const {
      return key.choices.empty()
                 ? "a table of names and numbers"
                 : fmt::format("a table of numbers for {}", fmt::join(key.choices, ", "));
    }
    std::string operator()(std::vector<std::pair<LandCoverClass, LandCoverClass>>*) const {
      return "a table of class names";
    }
    std::string operator()(std::string*) const {
      if (key.text == TextKind::choice || key.text == TextKind::built_in) {
        std::string names;
        for (const std::string& name : key_choices(key))
          names += (names.empty() ? "\"" : ", \"") + name + "\"";
        return names + (key.text == TextKind::built_in ? " or a file" : "");
      }
      if (key.text == TextKind::file) return "a file name";
      if (key.text == TextKind::time) return "date, time and zone as text";
      if (key.text == TextKind::date) return "month and day as text";
      return "text";
    }
  };
  Scene scene;  // the accessors only return an address, but the element must exist
  for (const SceneSection& section : scene_sections())
    if (section.resize != nullptr) section.resize(scene, 1);
  return std::visit(Visitor{key}, key.field(scene, 0));
}

}  // namespace belvedere
