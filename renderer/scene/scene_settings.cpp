#include "renderer/scene/scene_settings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text/parse_number.h"
#include "renderer/scene/scene_schema.h"

namespace belvedere {
namespace {

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

void mark(ConfigValue& value, ConfigPosition position) {
  value.position = position;
  if (auto* table = std::get_if<ConfigTable>(&value.value)) {
    for (ConfigEntry& entry : *table) {
      entry.key_position = position;
      mark(entry.value, position);
    }
  } else if (auto* array = std::get_if<ConfigArray>(&value.value)) {
    for (ConfigValue& element : *array) mark(element, position);
  }
}

// The defaults of a key that holds an array of numbers, so that one element of it can be set; an
// empty table for all other keys.
ConfigValue beginning_of(const std::string& section, const std::string& name,
                         ConfigPosition position) {
  ConfigValue value{.value = ConfigTable{}, .position = position};
  const SceneSection* child = find_section(join_key(section, name));
  if (child != nullptr && child->kind == SectionKind::list) value.value = ConfigArray{};
  const SceneSection* parent = find_section(section);
  const SceneKey* key = parent == nullptr ? nullptr : find_key(*parent, name);
  if (key == nullptr) return value;
  Scene scene;
  if (parent->resize != nullptr) parent->resize(scene, 1);
  const SceneField field = key->field(scene, 0);
  const auto numbers = [&](const auto& defaults) {
    ConfigArray array;
    for (const auto number : defaults) {
      ConfigValue& element = array.emplace_back();
      element.value = static_cast<double>(number);
      element.position = position;
    }
    value.value = std::move(array);
  };
  if (const auto* list = std::get_if<std::vector<float>*>(&field)) numbers(**list);
  if (const auto* pair = std::get_if<std::array<double, 2>*>(&field)) numbers(**pair);
  return value;
}

bool holds_text(const std::string& section, const std::string& name) {
  const SceneSection* parent = find_section(section);
  const SceneKey* key = parent == nullptr ? nullptr : find_key(*parent, name);
  if (key == nullptr) return false;
  Scene scene;
  if (parent->resize != nullptr) parent->resize(scene, 1);
  const SceneField field = key->field(scene, 0);
  return std::holds_alternative<std::string*>(field) ||
         std::holds_alternative<std::optional<LandCoverClass>*>(field);
}

// One --set on its way down the tables.
class Setting {
 public:
  Setting(std::string_view keys, ConfigPosition position, std::string where)
      : where_(std::move(where)), position_(position) {
    while (true) {
      const std::size_t dot = keys.find('.');
      path_.push_back(trimmed(keys.substr(0, dot)));
      if (path_.back().empty())
        throw Error(ErrorKind::usage, where_, "a part of the key is empty",
                    "names with dots between them");
      if (dot == std::string_view::npos) break;
      keys.remove_prefix(dot + 1);
    }
    constexpr std::size_t deepest = 8;
    if (path_.size() > deepest)
      throw Error(ErrorKind::usage, where_, "the key has too many parts",
                  fmt::format("at most {}", deepest));
  }

  // `make_value` gets the section and the name of the key.
  template <class MakeValue>
  void apply(ConfigValue& root, MakeValue&& make_value) {
    ConfigValue* node = &root;
    std::string section;  // dotted name of the table `node`, without list indices
    for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
      if (node->is_array()) {
        node = &element(*node, path_[i], ConfigTable{});
      } else {
        node = &entry(*node, path_[i], [&] { return beginning_of(section, path_[i], position_); });
        section = join_key(section, path_[i]);
      }
    }
    const std::string& last = path_.back();
    ConfigValue value = make_value(section, last);
    mark(value, position_);
    if (node->is_array()) {
      element(*node, last, false) = std::move(value);
      return;
    }
    ConfigValue& target = entry(*node, last, [] { return ConfigValue{}; });
    target = std::move(value);
    for (ConfigEntry& e : std::get<ConfigTable>(node->value))
      if (e.key == last) e.key_position = position_;
    drop_rivals(std::get<ConfigTable>(node->value), section, last);
  }

 private:
  ConfigValue& element(ConfigValue& list, const std::string& index_text,
                       decltype(ConfigValue::value) fresh) {
    auto& array = std::get<ConfigArray>(list.value);
    const std::size_t index = parse_number<std::size_t>(index_text).value_or(array.size() + 1);
    if (index > array.size())
      throw Error(ErrorKind::usage, where_,
                  fmt::format("\"{}\" is not an index of a list of {}", index_text, array.size()),
                  fmt::format("0 … {}; {} appends one", array.size(), array.size()));
    if (index == array.size()) {
      array.emplace_back().value = std::move(fresh);
      array.back().position = position_;
    }
    return array[index];
  }

  template <class Make>
  ConfigValue& entry(ConfigValue& node, const std::string& key, Make&& make) {
    auto* table = std::get_if<ConfigTable>(&node.value);
    if (table == nullptr)
      throw Error(ErrorKind::usage, where_,
                  fmt::format("nothing can be set below {}, which is {}", key, describe(node)),
                  "a key of a table");
    for (ConfigEntry& e : *table)
      if (e.key == key) return e.value;
    ConfigEntry& added = table->emplace_back();
    added.key = key;
    added.key_position = position_;
    added.value = make();
    return added.value;
  }

  // The command line has precedence: alternatives that the file sets are removed.
  static void drop_rivals(ConfigTable& table, std::string_view section, std::string_view key) {
    const auto has = [](const std::vector<std::string_view>& names, std::string_view name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const SceneExclusion& exclusion : scene_exclusions()) {
      if (exclusion.section != section) continue;
      const auto* rivals = has(exclusion.these, key)   ? &exclusion.those
                           : has(exclusion.those, key) ? &exclusion.these
                                                       : nullptr;
      if (rivals == nullptr) continue;
      std::erase_if(table, [&](const ConfigEntry& e) {
        return has(*rivals, e.key) && !is_setting(e.key_position);
      });
    }
  }

  std::string where_;
  ConfigPosition position_;
  std::vector<std::string> path_;
};

}  // namespace

// Lines of a file count from 1, so negative numbers are free for settings.
ConfigPosition place_of_setting(std::size_t index) { return {-1 - static_cast<int>(index), 0}; }

bool is_setting(ConfigPosition position) { return position.line < 0; }

std::string SceneOrigin::where(ConfigPosition position) const {
  if (!is_setting(position)) return config_where(file, position);
  return "--set " + settings.at(static_cast<std::size_t>(-1 - position.line));
}

void apply_settings(ConfigValue& root, const SceneOrigin& origin) {
  for (std::size_t i = 0; i < origin.settings.size(); ++i) {
    const std::string_view setting = origin.settings[i];
    const std::string where = "--set " + origin.settings[i];
    const std::size_t equals = setting.find('=');
    if (equals == std::string_view::npos || trimmed(setting.substr(0, equals)).empty())
      throw Error(ErrorKind::usage, where, "no \"=\"",
                  "key=value, such as --set output.width=1200");
    const std::string value = trimmed(setting.substr(equals + 1));
    const bool quoted = !value.empty() && (value.front() == '"' || value.front() == '\'');
    Setting(setting.substr(0, equals), place_of_setting(i), where)
        .apply(root, [&](const std::string& section, const std::string& name) {
          const bool is_word = holds_text(section, name) || value == "auto";
          return is_word && !quoted ? ConfigValue{.value = value, .position = place_of_setting(i)}
                                    : parse_config_value(value, where);
        });
  }
}

void set_scene_value(ConfigValue& root, const std::string& key, ConfigValue value) {
  Setting(key, place_of_setting(0), key).apply(root, [&](const std::string&, const std::string&) {
    return std::move(value);
  });
}

void spread_style(ConfigValue& root) {
  auto* table = std::get_if<ConfigTable>(&root.value);
  if (table == nullptr) return;
  for (ConfigEntry& entry : *table) {
    if (entry.key != "style" || !std::holds_alternative<std::string>(entry.value.value)) continue;
    ConfigEntry file{"file", entry.key_position, std::move(entry.value)};
    entry.value = ConfigValue{.value = ConfigTable{}, .position = entry.key_position};
    std::get<ConfigTable>(entry.value.value).push_back(std::move(file));
  }
}

std::string with_style_file(const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const std::size_t last = setting.find_last_not_of(" \t", equals == 0 ? 0 : equals - 1);
  const std::size_t first = setting.find_first_not_of(" \t");
  if (equals == std::string::npos || equals == 0 || last == std::string::npos) return setting;
  if (setting.substr(first, last + 1 - first) != "style") return setting;
  const std::size_t value = setting.find_first_not_of(" \t", equals + 1);
  if (value != std::string::npos && setting[value] == '{') return setting;  // the table itself
  return "style.file" + setting.substr(equals);
}

namespace {

int third(int px) {
  constexpr int min_px = 64;
  return std::min(px,
                  std::max(min_px, (px + 1) / 3));  // rounded, because thirds never lie on halves
}

}  // namespace

SceneOutput with_width(SceneOutput output, int width_px) {
  constexpr int min_px = 16;
  if (width_px == output.width) return output;
  output.height = std::max(min_px, static_cast<int>(std::lround(static_cast<double>(output.height) *
                                                                width_px / output.width)));
  output.width = width_px;
  return output;
}

Scene make_draft(Scene scene) {
  // The width of the sheet is unchanged, so strokes keep their size on it.
  scene.output.width = third(scene.output.width);
  scene.output.height = third(scene.output.height);
  scene.sampling.pixel_samples = 1;
  scene.sampling.sky_directions = (scene.sampling.sky_directions + 3) / 4;  // 0 stays none
  scene.synthesis.enabled = false;
  if (scene.water.mirror == "traced") scene.water.mirror = "column";
  return scene;
}

}  // namespace belvedere
