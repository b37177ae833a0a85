#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace belvedere {

// A parsed TOML document as plain values that remember where they stand: scenes, legends, palettes and class rules all
// come through here. config.cpp is the only file that knows the TOML library.
struct ConfigValue;
struct ConfigEntry;

struct ConfigPlace {
  int line = 0;    // from 1; 0 where a value has no place, as one set on the command line
  int column = 0;  // from 1
};

using ConfigArray = std::vector<ConfigValue>;
using ConfigTable = std::vector<ConfigEntry>;  // in the order of the file

struct ConfigValue {
  std::variant<bool, std::int64_t, double, std::string, ConfigArray, ConfigTable> value;
  ConfigPlace place;

  bool is_table() const { return std::holds_alternative<ConfigTable>(value); }
  bool is_array() const { return std::holds_alternative<ConfigArray>(value); }
};

struct ConfigEntry {
  std::string key;
  ConfigPlace key_place;
  ConfigValue value;
};

// The root table of a text. `name` is the file's name for messages. Throws Error(usage) `name:line:column` on a syntax
// error, on more than 1 MiB of text and on more than 100 levels of nesting; dates and times come as strings.
ConfigValue parse_config(std::string_view text, const std::string& name);
// Reads the file first: Error(input) where it is missing; its size is checked before it is read.
ConfigValue read_config(const std::string& path);
// The value of one `key = value` right-hand side, as for --set: TOML syntax, or else a bare word as a string.
ConfigValue parse_config_value(std::string_view text, const std::string& name);

// `name:line:column`, or `name` alone where there is no place.
std::string config_where(const std::string& name, ConfigPlace place);
// Throws Error(usage) at the place of the value.
[[noreturn]] void refuse_value(const ConfigValue& value, const std::string& name, std::string found, std::string allowed);
// What a value is, in words for messages: "the string \"abc\"", "the number 3", "a table" …
std::string describe(const ConfigValue& value);
// The candidate closest to `word` by edit distance, or an empty string where none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

// Strict access for small documents (legends, palettes, rules). Each throws Error(usage) naming place, finding and allowed type.
const ConfigTable& as_table(const ConfigValue& value, const std::string& name);
const ConfigArray& as_array(const ConfigValue& value, const std::string& name);
const std::string& as_string(const ConfigValue& value, const std::string& name);
double as_number(const ConfigValue& value, const std::string& name);
std::int64_t as_integer(const ConfigValue& value, const std::string& name);
bool as_bool(const ConfigValue& value, const std::string& name);
// The entry of that key, or null.
const ConfigValue* find(const ConfigTable& table, std::string_view key);
// Error(usage) for the first key that is not in `allowed`, with the nearest known one.
void allow_only(const ConfigTable& table, const std::vector<std::string>& allowed, const std::string& name);

}  // namespace belvedere
