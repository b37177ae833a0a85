#include "renderer/scene/edit/scene_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <variant>

#include "base/config.h"
#include "base/error.h"
#include "base/text/json.h"
#include "renderer/scene/edit/edited_text.h"
#include "renderer/scene/edit/toml_layout.h"
#include "renderer/scene/scene_file.h"
#include "renderer/scene/scene_settings.h"

namespace belvedere {
namespace {

TomlPath parts_of(const std::string& key) {
  TomlPath parts;
  for (std::size_t i = 0; i <= key.size();) {
    const std::size_t dot = std::min(key.find('.', i), key.size());
    parts.push_back(key.substr(i, dot - i));
    i = dot + 1;
  }
  return parts;
}

// The document, with its style as a table.
ConfigValue present_tree(const std::string& text, const std::string& name) {
  ConfigValue root = parse_config(text, name);
  spread_style(root);
  return root;
}

ConfigValue value_of(const SceneEdit& edit) {
  ConfigValue line;
  try {
    line = parse_config("v = " + *edit.value, edit.key);
  } catch (const Error& error) {
    throw Error(ErrorKind::usage, edit.key,
                fmt::format("the value {} is not valid: {}", *edit.value, error.found()),
                error.allowed());
  }
  auto& entries = std::get<ConfigTable>(line.value);
  if (entries.size() != 1)
    throw Error(ErrorKind::usage, edit.key, fmt::format("{} is not one value", *edit.value),
                "the TOML of one value");
  return std::move(entries.front().value);
}

void erase(ConfigValue& root, const TomlPath& path, const std::string& key) {
  ConfigValue* node = &root;
  for (std::size_t n = 0; n < path.size(); ++n) {
    const bool last = n + 1 == path.size();
    if (auto* table = std::get_if<ConfigTable>(&node->value)) {
      const auto entry = std::find_if(table->begin(), table->end(),
                                      [&](const ConfigEntry& e) { return e.key == path[n]; });
      if (entry == table->end()) return;
      node = &entry->value;
      if (last) table->erase(entry);
    } else if (auto* list = std::get_if<ConfigArray>(&node->value)) {
      std::size_t i = 0;
      while (i < list->size() && std::to_string(i) != path[n]) ++i;
      if (i == list->size())
        throw Error(ErrorKind::usage, key,
                    fmt::format("\"{}\" is not an index of a list of {}", path[n], i),
                    i == 0 ? "an element that exists" : fmt::format("0 … {}", i - 1));
      node = &(*list)[i];
      if (last) list->erase(list->begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      return;
    }
  }
}

// Tables and lists without content: those that removing leaves behind mean nothing.
bool is_vacant(const ConfigValue& value) {
  if (const auto* list = std::get_if<ConfigArray>(&value.value)) return list->empty();
  const auto* table = std::get_if<ConfigTable>(&value.value);
  return table != nullptr && std::all_of(table->begin(), table->end(),
                                         [](const ConfigEntry& e) { return is_vacant(e.value); });
}

// Whether two documents say the same, in whatever order.
bool says_same(const ConfigValue& a, const ConfigValue& b) {
  const auto* table_a = std::get_if<ConfigTable>(&a.value);
  const auto* table_b = std::get_if<ConfigTable>(&b.value);
  if (table_a != nullptr && table_b != nullptr) {
    const auto holds = [](const ConfigTable& in, const ConfigTable& all, bool compare) {
      return std::all_of(all.begin(), all.end(), [&](const ConfigEntry& entry) {
        const ConfigValue* other = find(in, entry.key);
        if (other == nullptr) return is_vacant(entry.value);
        return !compare || says_same(*other, entry.value);
      });
    };
    return holds(*table_a, *table_b, true) && holds(*table_b, *table_a, false);
  }
  const auto* list_a = std::get_if<ConfigArray>(&a.value);
  const auto* list_b = std::get_if<ConfigArray>(&b.value);
  if (list_a != nullptr && list_b != nullptr)
    return std::equal(list_a->begin(), list_a->end(), list_b->begin(), list_b->end(), says_same);
  const auto number = [](const ConfigValue& value) {
    const auto* whole = std::get_if<std::int64_t>(&value.value);
    const auto* real = std::get_if<double>(&value.value);
    return whole != nullptr  ? std::optional<double>(static_cast<double>(*whole))
           : real != nullptr ? std::optional<double>(*real)
                             : std::nullopt;
  };
  // 3 and 3.0 are one number; of two whole numbers every digit counts.
  if (a.value.index() != b.value.index()) return number(a) && number(a) == number(b);
  const auto* text = std::get_if<std::string>(&a.value);
  if (text != nullptr) return *text == std::get<std::string>(b.value);
  const auto* flag = std::get_if<bool>(&a.value);
  if (flag != nullptr) return *flag == std::get<bool>(b.value);
  const auto* whole = std::get_if<std::int64_t>(&a.value);
  if (whole != nullptr) return *whole == std::get<std::int64_t>(b.value);
  return number(a) == number(b);
}

// The place of a key in this text, which may use the short form of [style].
TomlPath present_path(EditedText& text, const std::string& key, const ConfigValue* value) {
  TomlPath path = parts_of(key);
  const TomlPath style = {"style"};
  if (path.front() == "style") {
    const std::optional<std::string> written = text.value_at(style);
    const bool is_short = written && !written->starts_with('{');
    if (path == TomlPath{"style", "file"} && is_short) return style;
    if (path == style && value != nullptr && std::holds_alternative<std::string>(value->value) &&
        !is_short && text.exists(style))
      return {"style", "file"};
    if (path.size() > 1 && is_short) text.rename(style, "style.file");
  }
  return path;
}

// "deform.handles" for the key of an element's key.
std::string section_of(const TomlPath& path, const ConfigValue& tree) {
  std::string section;
  const ConfigValue* node = &tree;
  for (std::size_t n = 0; n + 1 < path.size(); ++n) {
    if (!node->is_array()) section = join_key(section, path[n]);
    node = node_at(*node, {path[n]});
  }
  return section;
}

void drop_rivals(EditedText& text, const TomlPath& path, const ConfigValue& tree) {
  const auto has = [&](const std::vector<std::string_view>& names) {
    return std::find(names.begin(), names.end(), path.back()) != names.end();
  };
  const std::string section = section_of(path, tree);
  for (const SceneExclusion& exclusion : scene_exclusions()) {
    if (exclusion.section != section) continue;
    const auto* rivals = has(exclusion.these)   ? &exclusion.those
                         : has(exclusion.those) ? &exclusion.these
                                                : nullptr;
    if (rivals == nullptr) continue;
    for (const std::string_view rival : *rivals) {
      TomlPath place = path;
      place.back() = rival;
      text.remove(place);
    }
  }
}

std::string after(const std::string& text, const std::string& name, SceneEdit edit) {
  ConfigValue wanted = present_tree(text, name);
  EditedText out(text);
  if (!edit.value) {
    const TomlPath path = present_path(out, edit.key, nullptr);
    erase(wanted, parts_of(edit.key), edit.key);
    out.remove(path);
  } else {
    const std::size_t first = edit.value->find_first_not_of(" \t\r\n");
    if (first != std::string::npos)
      edit.value = edit.value->substr(first, edit.value->find_last_not_of(" \t\r\n") + 1 - first);
    const ConfigValue value = value_of(edit);
    if (edit.append) {
      const ConfigValue* list = node_at(wanted, parts_of(edit.key));
      const auto* array = list == nullptr ? nullptr : std::get_if<ConfigArray>(&list->value);
      if (list != nullptr && array == nullptr)
        throw Error(ErrorKind::usage, edit.key,
                    fmt::format("nothing can be appended to {}", describe(*list)), "a list");
      edit.key += fmt::format(".{}", array == nullptr ? 0 : array->size());
    }
    const TomlPath path = present_path(out, edit.key, &value);
    const bool is_short = edit.key == "style" && std::holds_alternative<std::string>(value.value);
    set_scene_value(wanted, is_short ? "style.file" : edit.key, value);
    out.set(path, *edit.value, wanted);
    drop_rivals(out, path, wanted);
  }
  const std::string changed = out.text();
  std::string problem;
  try {
    if (says_same(present_tree(changed, name), wanted)) return changed;
  } catch (const Error& error) {
    problem = ": " + error.found();
  }
  throw Error(ErrorKind::usage, edit.key,
              fmt::format("the text of {} cannot be changed so that only this key changes{}", name,
                          problem),
              "change the text itself");
}

}  // namespace

std::string edit_scene_text(const std::string& text, const std::string& name,
                            std::span<const SceneEdit> edits) {
  std::string out = text;
  for (const SceneEdit& edit : edits) out = after(out, name, edit);
  return out;
}

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
