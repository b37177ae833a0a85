#include "renderer/scene/former_keys.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace belvedere {
namespace {

struct FormerKey {
  std::string_view section;
  std::string_view former;
  std::string_view present;
};

// Keys renamed in version 0.2. A row is removed in the next version.
constexpr FormerKey former_keys[] = {
    {"terrain", "most_mcells", "max_mcells"},
    {"air.mist", "sight_m", "visibility_m"},
    {"synthesis", "knit", "synthesize_seams"},
    {"synthesis", "unlikeness", "class_dissimilarity"},
    {"features", "people_of", "population_of"},
    {"features", "keep_guesses", "keep_inferred"},
    {"labels", "least_prominence_m", "min_prominence_m"},
    {"land_cover.settings", "guesses", "inferred_villages"},  // a parameter of life_zones
};

std::string note_of(const FormerKey& key) {
  return fmt::format("{}.{} is now called {}.{}; the next version will not read the former name",
                     key.section, key.former, key.section, key.present);
}

void rename_in(ConfigTable& table, const FormerKey& key, std::vector<std::string>& notes) {
  const auto named = [&](std::string_view name) {
    return std::find_if(table.begin(), table.end(),
                        [&](const ConfigEntry& entry) { return entry.key == name; });
  };
  const auto former = named(key.former);
  if (former == table.end() || named(key.present) != table.end()) return;
  former->key = key.present;
  if (const std::string note = note_of(key);
      std::find(notes.begin(), notes.end(), note) == notes.end())
    notes.push_back(note);
}

// The tables of a section below `value`: "air.mist" may be a table, or a list of them.
void rename_below(ConfigValue& value, std::string_view section, const FormerKey& key,
                  std::vector<std::string>& notes) {
  if (auto* list = std::get_if<ConfigArray>(&value.value)) {
    for (ConfigValue& element : *list) rename_below(element, section, key, notes);
    return;
  }
  auto* table = std::get_if<ConfigTable>(&value.value);
  if (table == nullptr) return;
  if (section.empty()) return rename_in(*table, key, notes);
  const std::size_t dot = std::min(section.find('.'), section.size());
  for (ConfigEntry& entry : *table)
    if (entry.key == section.substr(0, dot))
      rename_below(entry.value, section.substr(std::min(dot + 1, section.size())), key, notes);
}

// "air.mist.0.sight_m" to "air.mist.sight_m".
std::string without_indices(std::string_view path) {
  std::string out;
  while (!path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const std::string_view part = path.substr(0, dot);
    if (part.empty() || std::isdigit(static_cast<unsigned char>(part.front())) == 0)
      out += (out.empty() ? "" : ".") + std::string(part);
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return out;
}

}  // namespace

std::vector<std::string> rename_former_keys(ConfigValue& root) {
  std::vector<std::string> notes;
  for (const FormerKey& key : former_keys) rename_below(root, key.section, key, notes);
  return notes;
}

std::string with_present_key(const std::string& setting, std::vector<std::string>& notes) {
  const std::size_t equals = std::min(setting.find('='), setting.size());
  const std::string path = setting.substr(0, equals);
  const std::string key_path = without_indices(path);
  for (const FormerKey& key : former_keys) {
    if (key_path != fmt::format("{}.{}", key.section, key.former)) continue;
    notes.push_back(note_of(key));
    return path.substr(0, path.size() - key.former.size()) + std::string(key.present) +
           setting.substr(equals);
  }
  return setting;
}

std::string former_name(const std::string& key) {
  const std::string key_path = without_indices(key);
  for (const FormerKey& row : former_keys)
    if (key_path == fmt::format("{}.{}", row.section, row.present)) return std::string(row.former);
  return {};
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

}  // namespace belvedere
