#include "terrain/cover/layers_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "terrain/cover/ground_variables.h"

namespace belvedere {
namespace {

// Words of expressions.
constexpr std::array<std::string_view, 14> words = {"and",  "or",    "not",        "min", "max",
                                                    "clip", "clamp", "abs",        "sin", "cos",
                                                    "exp",  "sqrt",  "smoothstep", "hat"};

bool is_name(std::string_view text) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !text.empty() && letter(text[0]) && std::all_of(text.begin(), text.end(), [&](char c) {
    return letter(c) || (c >= '0' && c <= '9');
  });
}

bool means_something(const std::string& name, const std::vector<std::string>& taken) {
  return std::find(words.begin(), words.end(), name) != words.end() ||
         find_ground_variable(name) != nullptr ||
         (name.starts_with("is_") && find_class(name.substr(3))) ||
         std::find(taken.begin(), taken.end(), name) != taken.end();
}

// The name of a parameter or a term.
void take_name(const LayersReader& reader, const ConfigEntry& entry,
               std::vector<std::string>& taken) {
  if (!is_name(entry.key))
    reader.fail(entry.key_position, "the name \"" + entry.key + "\"",
                "letters, digits and _, not starting with a digit");
  if (means_something(entry.key, taken))
    reader.fail(entry.key_position, "the name \"" + entry.key + "\" is already in use",
                "another name");
  taken.push_back(entry.key);
}

}  // namespace

void LayersReader::fail(ConfigPosition position, const std::string& found,
                        const std::string& allowed) const {
  throw Error(ErrorKind::usage, config_where(where, position), found, allowed);
}

void LayersReader::fail_unknown(ConfigPosition position, const std::string& what,
                                const std::string& word,
                                const std::vector<std::string>& known) const {
  const std::string near = nearest_word(word, known);
  fail(position,
       fmt::format("unknown {} \"{}\"{}", what, word,
                   near.empty() ? "" : "; did you mean \"" + near + "\"?"),
       fmt::format("{}", fmt::join(known, ", ")));
}

double LayersReader::number(const ConfigValue& value) const {
  const double read = as_number(value, where);
  if (!std::isfinite(read)) fail(value.position, describe(value), "a finite number");
  return read;
}

double LayersReader::number_or(const ConfigTable& table, std::string_view key,
                               double otherwise) const {
  const ConfigValue* value = find(table, key);
  return value == nullptr ? otherwise : number(*value);
}

std::string LayersReader::text_or(const ConfigTable& table, std::string_view key,
                                  const std::string& otherwise) const {
  const ConfigValue* value = find(table, key);
  return value == nullptr ? otherwise : as_string(*value, where);
}

std::string LayersReader::expression(const ConfigValue& value) const {
  const std::string& text = as_string(value, where);
  if (text.empty()) fail(value.position, "empty expression", "an expression");
  return text;
}

LandCoverClass as_ground_class(const ConfigValue& value, const std::string& where) {
  const std::string& word = as_string(value, where);
  const std::optional<LandCoverClass> found = find_class(word);
  if (found && *found != LandCoverClass::sky) return *found;
  std::vector<std::string> known;
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (info.id != LandCoverClass::sky) known.emplace_back(info.name);
  LayersReader{where}.fail_unknown(value.position, "class", word, known);
}

const ConfigValue& LayersReader::required(const ConfigTable& table, std::string_view key,
                                          ConfigPosition position, const std::string& of) const {
  const ConfigValue* value = find(table, key);
  if (value == nullptr) fail(position, fmt::format("{} without {}", of, key), std::string(key));
  return *value;
}

LayersDocument read_layers_document(const LayersReader& reader, const ConfigValue& document,
                                    const std::vector<std::string>& own_keys) {
  const ConfigTable& root = as_table(document, reader.where);
  std::vector<std::string> keys = {"version", "name", "parameters", "terms", "layers"};
  keys.insert(keys.end(), own_keys.begin(), own_keys.end());
  allow_only(root, keys, reader.where);
  const ConfigValue* version = find(root, "version");
  if (version == nullptr || as_integer(*version, reader.where) != 1)
    reader.fail(version == nullptr ? ConfigPosition{} : version->position,
                version == nullptr ? "no version" : describe(*version), "version = 1");

  LayersDocument read;
  read.name = reader.text_or(root, "name", "");
  std::vector<std::string> taken;
  if (const ConfigValue* parameters = find(root, "parameters"))
    for (const ConfigEntry& entry : as_table(*parameters, reader.where)) {
      take_name(reader, entry, taken);
      read.parameters.emplace_back(entry.key, reader.number(entry.value));
    }
  if (const ConfigValue* terms = find(root, "terms"))
    for (const ConfigEntry& entry : as_table(*terms, reader.where)) {
      take_name(reader, entry, taken);
      read.terms.emplace_back(entry.key, reader.expression(entry.value));
      read.term_places.push_back(entry.value.position);
    }
  return read;
}

const ConfigArray& layers_of(const LayersReader& reader, const ConfigValue& document) {
  const ConfigValue* layers = find(as_table(document, reader.where), "layers");
  if (layers == nullptr) reader.fail({}, "no layers", "[[layers]]");
  return as_array(*layers, reader.where);
}

}  // namespace belvedere
