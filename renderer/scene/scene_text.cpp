#include <fmt/format.h>

#include <cmath>

#include "base/text/json.h"
#include "renderer/image/picture_formats.h"
#include "renderer/scene/edit/scene_edit.h"
#include "renderer/scene/scene_file.h"
#include "renderer/scene/scene_schema.h"
#include "renderer/trace/camera.h"

// Texts derived from the table of scene_sections(): the JSON Schema and the reference.
namespace belvedere {
namespace {

// A scene in which every section exists, to read defaults from.
Scene full_scene() {
  Scene scene;
  for (const SceneSection& section : scene_sections())
    if (section.resize != nullptr) section.resize(scene, 1);
  return scene;
}

Json typed(std::string_view type) { return Json::object().add("type", Json::text(type)); }

Json number_schema(std::string_view type, const SceneRange& range) {
  Json out = typed(type);
  if (std::abs(range.min) < std::numeric_limits<double>::infinity())
    out.add("minimum", Json::number(range.min));
  if (range.above_min)
    out.add("exclusiveMinimum", Json::boolean(true));  // draft 4: a boolean beside minimum
  if (std::abs(range.max) < std::numeric_limits<double>::infinity())
    out.add("maximum", Json::number(range.max));
  return out;
}

struct SchemaOfField {
  const SceneKey& key;

  Json list(std::size_t min, std::size_t max) const {
    return typed("array")
        .add("items", number_schema("number", key.range))
        .add("minItems", Json::number(static_cast<double>(min)))
        .add("maxItems", Json::number(static_cast<double>(max)));
  }
  Json or_auto(Json schema) const {
    return Json::object().add(
        "anyOf",
        Json::array({std::move(schema), typed("string").add("enum", Json::texts({"auto"}))}));
  }
  Json classes() const { return typed("string").add("enum", Json::texts(ground_class_names())); }

  Json operator()(bool*) const { return typed("boolean"); }
  Json operator()(std::optional<bool>*) const { return or_auto(typed("boolean")); }
  Json operator()(int*) const { return number_schema("integer", key.range); }
  Json operator()(std::uint64_t*) const { return number_schema("integer", key.range); }
  Json operator()(double*) const { return number_schema("number", key.range); }
  Json operator()(float*) const { return number_schema("number", key.range); }
  Json operator()(std::optional<double>*) const {
    if (key.derived.empty()) return number_schema("number", key.range);
    return or_auto(number_schema("number", key.range));
  }
  Json operator()(std::optional<glm::dvec2>*) const { return position(); }
  Json operator()(std::vector<glm::dvec2>*) const {
    return typed("array")
        .add("items", position())
        .add("minItems", Json::number(3))
        .add("maxItems", Json::number(1000));
  }
  Json position() const {
    if (!key.lonlat) return list(2, 2);
    return typed("array")
        .add("items", Json::array({number_schema("number", {-180.0, 180.0}),
                                   number_schema("number", {-90.0, 90.0})}))
        .add("minItems", Json::number(2))
        .add("additionalItems", Json::boolean(false));
  }
  Json operator()(std::array<double, 2>*) const { return list(2, 2); }
  Json operator()(std::optional<std::array<double, 4>>*) const { return list(4, 4); }
  Json operator()(std::vector<float>*) const { return list(1, 12); }
  Json operator()(std::optional<LandCoverClass>*) const { return classes(); }
  Json operator()(std::vector<LandCoverClass>*) const {
    return typed("array").add("items", classes());
  }
  Json operator()(std::vector<std::string>*) const {
    return typed("array")
        .add("items", typed("string").add("enum", Json::texts(key_choices(key))))
        .add("minItems", Json::number(1))
        .add("uniqueItems", Json::boolean(true));
  }
  Json operator()(std::vector<std::pair<std::string, double>>*) const {
    if (key.choices.empty())
      return typed("object").add("additionalProperties", number_schema("number", key.range));
    Json names = Json::object();
    for (const std::string& name : key.choices) names.add(name, number_schema("number", key.range));
    return typed("object")
        .add("properties", names)
        .add("additionalProperties", Json::boolean(false));
  }
  Json operator()(std::vector<std::pair<LandCoverClass, LandCoverClass>>*) const {
    Json names = Json::object();
    for (const std::string& name : ground_class_names()) names.add(name, classes());
    return typed("object")
        .add("properties", names)
        .add("additionalProperties", Json::boolean(false));
  }
  Json operator()(std::string*) const {
    if (key.text == TextKind::choice)
      return typed("string").add("enum", Json::texts(key_choices(key)));
    if (key.text == TextKind::built_in)
      return Json::object().add(
          "anyOf", Json::array({typed("string").add("enum", Json::texts(key_choices(key))),
                                typed("string").add("pattern", Json::text(R"(\.(toml|csv)$)"))}));
    if (key.text == TextKind::date)
      return typed("string").add("pattern",
                                 Json::text(R"(^(0[1-9]|1[0-2])-(0[1-9]|[12]\d|3[01])$)"));
    if (key.text == TextKind::time)
      return typed("string").add(
          "pattern",
          Json::text(R"(^\d{4}-\d\d-\d\dT\d\d:\d\d(:\d\d(\.\d{1,9})?)?(Z|[+-]\d\d:\d\d)$)"));
    return typed("string");
  }
};

// Tables have no default of their own, and those of TOML are not JSON.
bool has_json_default(const SceneField& field) {
  return !std::holds_alternative<std::vector<std::pair<std::string, double>>*>(field) &&
         !std::holds_alternative<std::vector<std::pair<LandCoverClass, LandCoverClass>>*>(field);
}

std::string full_meaning(const SceneKey& key) {
  return std::string(key.meaning) +
         (key.derived.empty() ? "" : fmt::format(" Default: {}.", key.derived));
}

Json section_schema(const SceneSection& section, Scene& defaults) {
  Json properties = Json::object();
  std::vector<std::string> required;
  for (const SceneKey& key : section.keys) {
    const SceneField field = key.field(defaults, 0);
    Json schema = std::visit(SchemaOfField{key}, field);
    const std::string unit = key.unit.empty() ? "" : fmt::format(" Unit: {}.", key.unit);
    schema.add("description", Json::text(full_meaning(key) + unit));
    const std::string value = value_text(field);
    if (!value.empty() && !key.required && has_json_default(field))
      schema.add("default", Json::raw(value));
    properties.add(key.name, std::move(schema));
    if (key.required) required.emplace_back(key.name);
  }
  for (const SceneSection* child : child_sections(section.name)) {
    Json schema = section_schema(*child, defaults);
    if (child->kind == SectionKind::list)
      schema = typed("array")
                   .add("description", Json::text(child->meaning))
                   .add("items", std::move(schema));
    properties.add(child->name.substr(section.name.empty() ? 0 : section.name.size() + 1),
                   std::move(schema));
  }
  Json out = typed("object")
                 .add("description", Json::text(section.meaning))
                 .add("properties", std::move(properties));
  if (!required.empty()) out.add("required", Json::texts(required));
  std::vector<Json> exclusions;
  for (const SceneExclusion& exclusion : scene_exclusions())
    if (exclusion.section == section.name)
      for (const std::string_view a : exclusion.these)
        for (const std::string_view b : exclusion.those)
          exclusions.push_back(Json::object().add(
              "not",
              Json::object().add("required", Json::texts({std::string(a), std::string(b)}))));
  if (!exclusions.empty()) out.add("allOf", Json::array(std::move(exclusions)));
  return out.add("additionalProperties", Json::boolean(false));
}

std::string table_cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

}  // namespace

std::string scene_json_schema() {
  Scene defaults = full_scene();
  Json schema = section_schema(*find_section(""), defaults);
  Json out = Json::object()
                 .add("$schema", Json::text("http://json-schema.org/draft-04/schema#"))
                 .add("title", Json::text("A scene of Belvedere"));
  return out.add("allOf", Json::array({std::move(schema)})).str() + "\n";
}

std::string scene_reference() {
  Scene defaults = full_scene();
  std::string out =
      "# Scene files\n"
      "\n"
      "Made by `belvedere schema --markdown`; `docs/scene.schema.json`, made by `belvedere "
      "schema`, is the same reference for editors.\n"
      "\n"
      "A scene is a TOML file that describes one panorama. `version = 1` is required; every other "
      "key has a default. An unknown\n"
      "key, a wrong type or a value out of range is an error with its line. Units are part of the "
      "keys' names; positions are in metres of\n"
      "the scene's CRS. Files are searched beside the scene file, then in the folders given with "
      "`--data`, and nowhere else;\n"
      "rasters also on servers, by their address, if `--allow-http` is given "
      "([ci.md](ci.md#data-on-servers)).\n"
      "Any key can be set on the command line: `--set output.width=1200`, `--set "
      "exemplar.0.seed=3`,\n"
      "`--set 'generalize.foreground=[1, 1, 0.5]'`; it replaces the file's value and its "
      "alternatives.\n"
      "\n"
      "```toml\n"
      "version = 1\n"
      "title = \"Karwendel from the north\"\n"
      "\n"
      "[[terrain.sources]]\n"
      "file = \"innsbruck/innsbruck_utm32_30m.tif\"\n"
      "\n"
      "[camera]\n"
      "position = [692000, 5302000]\n"
      "height_m = 22000\n"
      "look_at = [690000, 5249000]\n"
      "```\n";
  for (const SceneSection& section : scene_sections()) {
    const char* heading = section.name.empty()                ? "\n"
                                                                "## Top level\n"
                                                                "\n"
                          : section.kind == SectionKind::list ? "\n## `[[{}]]`\n\n"
                                                              : "\n## `[{}]`\n\n";
    out += fmt::format(fmt::runtime(heading), section.name) + std::string(section.meaning) + "\n\n";
    out += "| key | value | default | meaning |\n|---|---|---|---|\n";
    for (const SceneKey& key : section.keys) {
      const std::string range = describe_range(key);
      const std::string value = key.required ? "**required**" : value_text(key.field(defaults, 0));
      out += fmt::format("| `{}` | {}{} | {} | {} |\n", key.name, table_cell(describe_type(key)),
                         range.empty() ? "" : "; " + range,
                         key.required || value.empty()
                             ? std::string(key.derived.empty() ? value : "`\"auto\"`")
                             : "`" + table_cell(value) + "`",
                         table_cell(full_meaning(key)));
    }
    for (const SceneExclusion& exclusion : scene_exclusions())
      if (exclusion.section == section.name)
        out += fmt::format("\n`{}` and `{}` exclude each other.\n",
                           fmt::join(exclusion.these, "`, `"), fmt::join(exclusion.those, "`, `"));
  }
  out +=
      "\n"
      "## Projections\n"
      "\n"
      "| name | description | field of view |\n"
      "|---|---|---|\n";
  for (const Projection& projection : projections())
    out += fmt::format("| `{}` | {} | {} |\n", projection.name, table_cell(projection.meaning),
                       projection.widest_deg > 0.0 ? fmt::format("up to {}°", projection.widest_deg)
                                                   : "none; uses `view_width_m`");
  out +=
      "\n"
      "## Formats\n"
      "\n"
      "| extension | use | content |\n"
      "|---|---|---|\n";
  for (const PictureFormat& format : picture_formats())
    if (format.open != nullptr)
      out += fmt::format("| `{}` | {} | {} |\n", format.extension, format.meaning,
                         describe_format(format));
  out +=
      "\n"
      "## Classes\n"
      "\n"
      "Numbers of the classes in class images (`exemplar.classes`).\n"
      "\n"
      "| number | class |\n"
      "|---|---|\n";
  for (const LandCoverClassInfo& info : land_cover_classes())
    out += fmt::format("| {} | `{}` |\n", static_cast<int>(info.id), info.name);
  return out;
}

}  // namespace belvedere
