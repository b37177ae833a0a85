#include "renderer/scene/edit/scene_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "base/config.h"
#include "base/error.h"
#include "renderer/scene/edit/edited_text.h"
#include "renderer/scene/former_keys.h"
#include "renderer/scene/scene_schema.h"
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

// The document with present names of all keys.
ConfigValue present_tree(const std::string& text, const std::string& name) {
  ConfigValue root = parse_config(text, name);
  rename_former_keys(root);
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

// The place of a key in this text, which may use a former name or the short form of [style].
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
    return path;
  }
  const std::string former = former_name(key);
  if (!former.empty() && !text.exists(path)) {
    TomlPath place = path;
    place.back() = former;
    text.rename(place, path.back());
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
  std::vector<std::string> notes;
  edit.key = with_present_key(edit.key, notes);
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

}  // namespace belvedere
