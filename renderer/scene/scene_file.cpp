#include "renderer/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <regex>

#include "base/config.h"
#include "renderer/scene/scene_rules.h"
#include "renderer/scene/scene_schema.h"
#include "renderer/scene/scene_settings.h"
#include "terrain/io/http_access.h"

namespace belvedere {
namespace {

std::string listed(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

// One value into its field. `key_name` is the dotted name for messages.
class ValueReader {
 public:
  ValueReader(const SceneKey& key, std::string key_name, const ConfigValue& value,
              const LoadedScene& scene, const SceneOrigin& origin)
      : key_(key), key_name_(std::move(key_name)), value_(value), scene_(scene), origin_(origin) {}

  void operator()(bool* field) const {
    if (const bool* flag = std::get_if<bool>(&value_.value))
      *field = *flag;
    else
      wrong(value_);
  }
  void operator()(std::optional<bool>* field) const {
    if (is_auto())
      field->reset();
    else if (const bool* flag = std::get_if<bool>(&value_.value))
      *field = *flag;
    else
      wrong(value_);
  }
  void operator()(int* field) const { *field = static_cast<int>(integer()); }
  void operator()(std::uint64_t* field) const { *field = static_cast<std::uint64_t>(integer()); }
  void operator()(double* field) const { *field = number(value_, key_.range); }
  void operator()(float* field) const { *field = static_cast<float>(number(value_, key_.range)); }
  void operator()(std::optional<double>* field) const {
    if (is_auto())
      field->reset();
    else
      *field = number(value_, key_.range);
  }
  void operator()(std::optional<glm::dvec2>* field) const {
    const std::vector<double> pair = numbers(2, 2);
    *field = glm::dvec2(pair[0], pair[1]);
  }
  void operator()(std::array<double, 2>* field) const {
    const std::vector<double> pair = numbers(2, 2);
    *field = {pair[0], pair[1]};
  }
  void operator()(std::optional<std::array<double, 4>>* field) const {
    const std::vector<double> four = numbers(4, 4);
    *field = {four[0], four[1], four[2], four[3]};
  }
  void operator()(std::vector<glm::dvec2>* field) const {
    constexpr std::size_t min = 3;
    constexpr std::size_t max = 1000;
    const auto* array = std::get_if<ConfigArray>(&value_.value);
    if (array == nullptr || array->size() < min || array->size() > max) wrong(value_);
    field->clear();
    for (const ConfigValue& entry : *array) {
      const std::vector<double> position = numbers(entry, 2, 2);
      field->emplace_back(position[0], position[1]);
    }
  }
  void operator()(std::vector<float>* field) const {
    constexpr std::size_t max_bands = 12;
    const std::vector<double> list = numbers(1, max_bands);
    field->assign(list.begin(), list.end());
  }
  void operator()(std::optional<LandCoverClass>* field) const { *field = class_of(value_); }
  void operator()(std::vector<LandCoverClass>* field) const {
    const auto* array = std::get_if<ConfigArray>(&value_.value);
    if (array == nullptr) wrong(value_);
    field->clear();
    for (const ConfigValue& entry : *array) field->push_back(class_of(entry));
  }
  void operator()(std::vector<std::string>* field) const {
    const auto* array = std::get_if<ConfigArray>(&value_.value);
    if (array == nullptr || array->empty()) wrong(value_);
    field->clear();
    const std::vector<std::string> names = key_choices(key_);
    for (const ConfigValue& entry : *array) {
      const std::string* name = std::get_if<std::string>(&entry.value);
      if (name == nullptr) wrong(entry);
      if (std::find(names.begin(), names.end(), *name) == names.end())
        refuse(entry,
               fmt::format("{} has \"{}\"{}", key_name_, *name, nearest_word_hint(*name, names)),
               listed(names));
      if (std::find(field->begin(), field->end(), *name) != field->end())
        refuse(entry, fmt::format("{} has \"{}\" twice", key_name_, *name), "each name once");
      field->push_back(*name);
    }
  }
  void operator()(std::vector<std::pair<std::string, double>>* field) const {
    field->clear();
    for (const ConfigEntry& entry : table()) {
      const std::vector<std::string> names = key_choices(key_);
      if (!names.empty() && std::find(names.begin(), names.end(), entry.key) == names.end())
        throw Error(ErrorKind::usage, origin_.where(entry.key_position),
                    fmt::format("{}: unknown name \"{}\"{}", key_name_, entry.key,
                                nearest_word_hint(entry.key, names)),
                    listed(names));
      field->emplace_back(entry.key, number(entry.value, key_.range));
    }
  }
  void operator()(std::vector<std::pair<LandCoverClass, LandCoverClass>>* field) const {
    field->clear();
    for (const ConfigEntry& entry : table()) {
      const LandCoverClass from = class_of({.value = entry.key, .position = entry.key_position});
      const LandCoverClass to = class_of(entry.value);
      if (from == to)
        refuse(entry.value, fmt::format("{} is mapped to itself", entry.key), "another class");
      field->emplace_back(from, to);
    }
  }
  void operator()(std::string* field) const {
    const std::string* text = std::get_if<std::string>(&value_.value);
    if (text == nullptr) wrong(value_);
    if (key_.text == TextKind::file || key_.text == TextKind::built_in)
      if (const std::string misread = misread_path(*text); !misread.empty())
        refuse(value_, key_name_ + ": " + misread, backslash_advice());
    if (std::any_of(text->begin(), text->end(), [](unsigned char c) {
          return (c < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
        }))
      refuse(value_, key_name_ + " contains control characters", "text");
    // An absent key and an empty string mean the same, where a key may be absent.
    if (!(text->empty() && field->empty())) check_text(*text);
    *field = *text;
  }

 private:
  [[noreturn]] void refuse(const ConfigValue& at, const std::string& found,
                           const std::string& allowed) const {
    throw Error(ErrorKind::usage, origin_.where(at.position), found, allowed);
  }
  bool is_auto() const {
    const auto* word = std::get_if<std::string>(&value_.value);
    return !key_.derived.empty() && word != nullptr && *word == "auto";
  }

  [[noreturn]] void wrong(const ConfigValue& at) const {
    const std::string range = describe_range(key_);
    refuse(at, fmt::format("{} is {}", key_name_, describe(at)),
           describe_type(key_) + (range.empty() ? "" : ", " + range));
  }

  double number(const ConfigValue& at, const SceneRange& range) const {
    double out = 0.0;
    if (const auto* whole = std::get_if<std::int64_t>(&at.value))
      out = static_cast<double>(*whole);
    else if (const auto* real = std::get_if<double>(&at.value))
      out = *real;
    else
      wrong(at);
    // Written so that nan is refused as well.
    if (!(out >= range.min && out <= range.max) || (range.above_min && out == range.min) ||
        !std::isfinite(out))
      wrong(at);
    return out;
  }

  std::int64_t integer() const {
    const auto* whole = std::get_if<std::int64_t>(&value_.value);
    if (whole == nullptr) wrong(value_);
    number(value_, key_.range);
    return *whole;
  }

  std::vector<double> numbers(std::size_t min, std::size_t max) const {
    return numbers(value_, min, max);
  }
  std::vector<double> numbers(const ConfigValue& at, std::size_t min, std::size_t max) const {
    const auto* array = std::get_if<ConfigArray>(&at.value);
    if (array == nullptr || array->size() < min || array->size() > max) wrong(at);
    std::vector<double> out;
    for (std::size_t i = 0; i < array->size(); ++i) {
      SceneRange range = key_.range;
      if (key_.lonlat) range = i == 0 ? SceneRange{-180.0, 180.0} : SceneRange{-90.0, 90.0};
      out.push_back(number((*array)[i], range));
    }
    return out;
  }

  const ConfigTable& table() const {
    const auto* entries = std::get_if<ConfigTable>(&value_.value);
    if (entries == nullptr) wrong(value_);
    return *entries;
  }

  LandCoverClass class_of(const ConfigValue& at) const {
    const std::vector<std::string> names = ground_class_names();
    const auto* name = std::get_if<std::string>(&at.value);
    const auto found = name == nullptr ? std::nullopt : find_ground_class(*name);
    if (!found)
      refuse(at,
             fmt::format("{} has {}, which is not a class{}", key_name_, describe(at),
                         name == nullptr ? "" : nearest_word_hint(*name, names)),
             listed(names));
    return *found;
  }

  void check_text(const std::string& text) const {
    const std::vector<std::string> names = key_choices(key_);
    const bool known = std::find(names.begin(), names.end(), text) != names.end();
    if (key_.text == TextKind::choice && !known)
      refuse(value_,
             fmt::format("{} is {}{}", key_name_, describe(value_), nearest_word_hint(text, names)),
             describe_type(key_));
    if (key_.text == TextKind::built_in && !known) {
      if (!text.ends_with(".toml") && !text.ends_with(".csv"))
        refuse(value_,
               fmt::format("{} is {}, which is neither a built-in name nor a .toml or .csv file{}",
                           key_name_, describe(value_), nearest_word_hint(text, names)),
               describe_type(key_));
      check_file(text);
    }
    if (key_.text == TextKind::file) check_file(text);
    if (key_.text == TextKind::date) check_date(text);
    if (key_.text == TextKind::time) {
      static const std::regex moment(
          R"(\d{4}-\d\d-\d\dT\d\d:\d\d(:\d\d(\.\d{1,9})?)?(Z|[+-]\d\d:\d\d))");
      if (!std::regex_match(text, moment))
        refuse(value_, fmt::format("{} is {}", key_name_, describe(value_)),
               "ISO 8601 with a zone, such as \"2024-06-21T17:30:00+02:00\" or "
               "\"2024-06-21T15:30:00Z\"");
    }
  }

  // A day that exists in some year.
  void check_date(const std::string& text) const {
    static const std::regex day(R"(\d\d-\d\d)");
    constexpr std::array<int, 12> days = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool formed = std::regex_match(text, day);
    const int month = formed ? std::stoi(text.substr(0, 2)) : 0;
    const int of_month = formed ? std::stoi(text.substr(3)) : 0;
    if (month < 1 || month > 12 || of_month < 1 ||
        of_month > days[static_cast<std::size_t>(month - 1)])
      refuse(value_, fmt::format("{} is {}", key_name_, describe(value_)),
             "month and day, such as \"10-05\" for the fifth of October");
  }

  void check_file(const std::string& file) const {
    if (file.empty()) refuse(value_, key_name_ + " is empty", "a file name");
    if (is_address(file) && !key_.raster)
      refuse(value_, fmt::format("{} is {}", key_name_, describe(value_)),
             "a local file: only rasters are read from servers");
    try {
      find_scene_file(scene_, file);
    } catch (const Error& error) {
      refuse(value_, fmt::format("{} is {}: {}", key_name_, describe(value_), error.found()),
             error.allowed());
    }
  }

  const SceneKey& key_;
  std::string key_name_;
  const ConfigValue& value_;
  const LoadedScene& scene_;
  const SceneOrigin& origin_;
};

// An empty string excludes nothing either.
const ConfigEntry* given(const ConfigTable& table, std::string_view key) {
  for (const ConfigEntry& entry : table) {
    const auto* text = std::get_if<std::string>(&entry.value.value);
    if (entry.key == key) return text != nullptr && text->empty() ? nullptr : &entry;
  }
  return nullptr;
}

class SceneReader {
 public:
  SceneReader(LoadedScene& loaded, const SceneOrigin& origin) : loaded_(loaded), origin_(origin) {}

  void read(const ConfigValue& root) {
    // A later format has other keys, so this is reported first.
    const ConfigTable& table = std::get<ConfigTable>(root.value);
    if (const ConfigEntry* version = given(table, "version"))
      std::visit(ValueReader(*find_key(*find_section(""), "version"), "version", version->value,
                             loaded_, origin_),
                 SceneField(&loaded_.scene.version));
    read_table(*find_section(""), "", root, 0);
  }

 private:
  [[noreturn]] void refuse(ConfigPosition position, const std::string& found,
                           const std::string& allowed) const {
    throw Error(ErrorKind::usage, origin_.where(position), found, allowed);
  }

  // `name` has the indices of list elements: "exemplar.0".
  void read_table(const SceneSection& section, const std::string& name, const ConfigValue& value,
                  std::size_t i) {
    const auto* table = std::get_if<ConfigTable>(&value.value);
    if (table == nullptr)
      refuse(value.position, fmt::format("{} is {}", name, describe(value)),
             fmt::format("a table, [{}]", section.name));
    const std::vector<const SceneSection*> children = child_sections(section.name);
    for (const ConfigEntry& entry : *table) {
      const auto child = std::find_if(children.begin(), children.end(), [&](const SceneSection* c) {
        return c->name == join_key(section.name, entry.key);
      });
      if (const SceneKey* key = find_key(section, entry.key)) {
        std::visit(ValueReader(*key, join_key(name, entry.key), entry.value, loaded_, origin_),
                   key->field(loaded_.scene, i));
      } else if (child != children.end()) {
        read_section(**child, entry.value);
      } else {
        unknown_key(section, name, entry, children);
      }
    }
    for (const SceneKey& key : section.keys)
      if (key.required && given(*table, key.name) == nullptr)
        refuse(value.position, fmt::format("{} is missing", join_key(name, key.name)),
               fmt::format("{} = {}", key.name, key.name == "version" ? "1" : describe_type(key)));
    check_exclusions(section, name, *table);
  }

  void read_section(const SceneSection& section, const ConfigValue& value) {
    const std::string name(section.name);
    if (section.kind != SectionKind::list) {
      if (section.resize != nullptr) section.resize(loaded_.scene, 1);
      return read_table(section, name, value, 0);
    }
    const auto* array = std::get_if<ConfigArray>(&value.value);
    if (array == nullptr)
      refuse(value.position, fmt::format("{} is {}", name, describe(value)),
             fmt::format("blocks that begin with [[{}]]", name));
    constexpr std::size_t max = 1000;
    if (array->size() > max)
      refuse(value.position, fmt::format("{} has {} blocks", name, array->size()),
             fmt::format("at most {}", max));
    section.resize(loaded_.scene, array->size());
    for (std::size_t i = 0; i < array->size(); ++i)
      read_table(section, join_key(name, std::to_string(i)), (*array)[i], i);
  }

  [[noreturn]] void unknown_key(const SceneSection& section, const std::string& name,
                                const ConfigEntry& entry,
                                const std::vector<const SceneSection*>& children) const {
    std::vector<std::string> known;
    for (const SceneKey& key : section.keys) known.emplace_back(key.name);
    for (const SceneSection* child : children)
      known.emplace_back(child->name.substr(section.name.empty() ? 0 : section.name.size() + 1));
    std::string hint = nearest_word_hint(entry.key, known);
    if (hint.empty()) {
      // The key exists, but in another table.
      for (const SceneSection& other : scene_sections())
        if (find_key(other, entry.key) != nullptr ||
            (!other.name.empty() && other.name.ends_with("." + entry.key)))
          hint += (hint.empty() ? "; there is " : ", ") +
                  join_key(other.name, find_key(other, entry.key) != nullptr ? entry.key : "");
    }
    refuse(entry.key_position, fmt::format("unknown key \"{}\"{}", join_key(name, entry.key), hint),
           listed(known));
  }

  void check_exclusions(const SceneSection& section, const std::string& name,
                        const ConfigTable& table) const {
    for (const SceneExclusion& exclusion : scene_exclusions()) {
      if (exclusion.section != section.name) continue;
      for (const std::string_view a : exclusion.these)
        for (const std::string_view b : exclusion.those) {
          const ConfigEntry* first = given(table, a);
          const ConfigEntry* second = given(table, b);
          if (first != nullptr && second != nullptr)
            refuse(
                second->key_position,
                fmt::format("{} and {} exclude each other", join_key(name, a), join_key(name, b)),
                "one of the two");
        }
    }
  }

  LoadedScene& loaded_;
  const SceneOrigin& origin_;
};

LoadedScene load(ConfigValue root, const std::string& name, const std::string& folder,
                 const SceneFileOptions& options) {
  LoadedScene loaded;
  loaded.folder = folder.empty() ? "." : folder;
  loaded.name = std::filesystem::path(name).stem().string();
  loaded.allowed_folders = {loaded.folder};
  loaded.allowed_folders.insert(loaded.allowed_folders.end(), options.data_folders.begin(),
                                options.data_folders.end());
  const SceneOrigin origin{.file = name, .settings = options.settings};
  spread_style(root);
  SceneOrigin present = origin;
  for (std::string& setting : present.settings) setting = with_style_file(setting);
  apply_settings(root, present);
  SceneReader(loaded, origin).read(root);
  apply_scene_rules(loaded.scene, root, origin);
  return loaded;
}

}  // namespace

LoadedScene parse_scene(const std::string& text, const std::string& name, const std::string& folder,
                        const SceneFileOptions& options) {
  return load(parse_config(text, name), name, folder, options);
}

LoadedScene read_scene(const std::string& path, const SceneFileOptions& options) {
  return load(read_config(path), path, std::filesystem::path(path).parent_path().string(), options);
}

}  // namespace belvedere
