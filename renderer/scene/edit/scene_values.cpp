#include "renderer/scene/edit/scene_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <variant>

#include "base/text/json.h"
#include "renderer/scene/edit/toml_layout.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {
namespace {

template <class List>
std::string bracketed(const List& list) {
  return fmt::format("[{}]", fmt::join(list, ", "));
}

struct ValueWriter {
  ValueForm form;

  std::string operator()(const bool* field) const { return *field ? "true" : "false"; }
  std::string operator()(const std::optional<bool>* field) const {
    return *field ? (**field ? "true" : "false") : "";
  }
  std::string operator()(const int* field) const { return fmt::format("{}", *field); }
  std::string operator()(const std::uint64_t* field) const { return fmt::format("{}", *field); }
  std::string operator()(const double* field) const {
    return fmt::format("{}", *field);
  }  // shortest that reads back the same
  std::string operator()(const float* field) const { return fmt::format("{}", *field); }
  std::string operator()(const std::optional<double>* field) const {
    return *field ? fmt::format("{}", **field) : "";
  }
  std::string operator()(const std::string* field) const {
    return field->empty() ? "" : json_quoted(*field);
  }
  std::string operator()(const std::optional<glm::dvec2>* field) const {
    return *field ? bracketed(std::array{(*field)->x, (*field)->y}) : "";
  }
  std::string operator()(const std::array<double, 2>* field) const { return bracketed(*field); }
  std::string operator()(const std::optional<std::array<double, 4>>* field) const {
    return *field ? bracketed(**field) : "";
  }
  std::string operator()(const std::vector<glm::dvec2>* field) const {
    std::vector<std::string> positions;
    for (const glm::dvec2 position : *field)
      positions.push_back(bracketed(std::array{position.x, position.y}));
    return positions.empty() ? "" : bracketed(positions);
  }
  // An empty set of weights is not written.
  std::string operator()(const std::vector<float>* field) const {
    return field->empty() ? "" : bracketed(*field);
  }
  std::string operator()(const std::optional<LandCoverClass>* field) const {
    return *field ? json_quoted(class_name(**field)) : "";
  }
  std::string operator()(const std::vector<LandCoverClass>* field) const {
    std::vector<std::string> entries;
    for (const LandCoverClass id : *field) entries.push_back(json_quoted(class_name(id)));
    return bracketed(entries);
  }
  std::string operator()(const std::vector<std::string>* field) const {
    std::vector<std::string> entries;
    for (const std::string& name : *field) entries.push_back(json_quoted(name));
    return bracketed(entries);
  }
  std::string operator()(const std::vector<std::pair<std::string, double>>* field) const {
    std::vector<std::string> entries;
    for (const auto& [name, number] : *field)
      entries.push_back(member(name, fmt::format("{}", number)));
    return table(entries);
  }
  std::string operator()(
      const std::vector<std::pair<LandCoverClass, LandCoverClass>>* field) const {
    std::vector<std::string> entries;
    for (const auto& [from, to] : *field)
      entries.push_back(member(class_name(from), json_quoted(class_name(to))));
    return table(entries);
  }

  std::string member(std::string_view name, const std::string& value) const {
    return form == ValueForm::json ? json_quoted(name) + ": " + value
                                   : toml_key(name) + " = " + value;
  }
  static std::string table(const std::vector<std::string>& entries) {
    return entries.empty() ? "" : fmt::format("{{ {} }}", fmt::join(entries, ", "));
  }
};

// Keys whose defaults would contradict what is set, such as an azimuth with a point to look at.
bool is_excluded(const SceneSection& section, const SceneKey& key, Scene& scene, std::size_t i) {
  for (const SceneExclusion& exclusion : scene_exclusions()) {
    if (exclusion.section != section.name ||
        std::find(exclusion.those.begin(), exclusion.those.end(), key.name) ==
            exclusion.those.end())
      continue;
    for (const std::string_view rival : exclusion.these)
      if (!value_text(find_key(section, rival)->field(scene, i)).empty()) return true;
  }
  if (section.name != "exemplar") return false;
  // Keys that cannot be set for an exemplar without a picture, for a model, or for neither.
  static constexpr std::array<std::string_view, 10> of_pictures = {
      "altitude_range_m", "distance_range_m", "optional", "found_shadow", "excluded",
      "stroke_px",        "serves",           "prefer",   "light",        "classes_from"};
  static constexpr std::array<std::string_view, 8> of_no_model = {
      "altitude_range_m", "classes_from", "distance_range_m", "found_shadow",
      "excluded",         "width",        "height",           "seed"};
  const auto names_it = [&](const auto& keys) {
    return std::find(keys.begin(), keys.end(), key.name) != keys.end();
  };
  if (!scene.exemplars[i].model.empty()) return names_it(of_no_model);
  if (key.name == "excluded" && scene.exemplars[i].exclude.empty()) return true;
  return scene.exemplars[i].picture.empty() ? names_it(of_pictures)
                                            : key.name == "prefer" || key.name == "light";
}

// begin(section, i) for each section and each element of a list, then write(key, text) for each of
// its keys that is in effect.
template <class Begin, class Write>
void for_each_value(Scene& scene, ValueForm form, Begin&& begin, Write&& write) {
  for (const SceneSection& section : scene_sections()) {
    const std::size_t count = section.count == nullptr ? 1 : section.count(scene);
    for (std::size_t i = 0; i < count; ++i) {
      begin(section, i);
      for (const SceneKey& key : section.keys) {
        if (is_excluded(section, key, scene, i)) continue;
        const std::string text = value_text(key.field(scene, i), form);
        if (!text.empty()) write(key, text);
      }
    }
  }
}

}  // namespace

std::string value_text(const SceneField& field, ValueForm form) {
  return std::visit(ValueWriter{form}, field);
}

std::vector<std::pair<std::string, std::string>> scene_values(Scene scene, ValueForm form,
                                                              std::string_view section) {
  std::vector<std::pair<std::string, std::string>> values;
  std::string above;
  for_each_value(
      scene, form,
      [&](const SceneSection& part, std::size_t i) {
        above = part.name;
        if (part.kind == SectionKind::list) above += fmt::format(".{}", i);
      },
      [&](const SceneKey& key, const std::string& text) {
        if (section.empty() || above == section)
          values.emplace_back(join_key(above, key.name), text);
      });
  return values;
}

std::string write_scene(const Scene& scene) {
  Scene values = scene;  // the accessors need one to write to
  std::string out;
  for_each_value(
      values, ValueForm::toml,
      [&](const SceneSection& section, std::size_t) {
        if (section.name.empty()) return;
        const bool list = section.kind == SectionKind::list;
        out +=
            list ? fmt::format("\n[[{}]]\n", section.name) : fmt::format("\n[{}]\n", section.name);
      },
      [&](const SceneKey& key, const std::string& text) {
        out += fmt::format("{} = {}\n", key.name, text);
      });
  return out;
}

}  // namespace belvedere
