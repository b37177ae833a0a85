#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace belvedere {

// A parsed TOML document as plain values with their positions. Scenes, legends, palettes and class
// rules are all read through it. Only config.cpp uses the TOML library.
struct ConfigValue;
struct ConfigEntry;

struct ConfigPosition {
  int line = 0;    // from 1; 0 for a value without a position, as from the command line
  int column = 0;  // from 1
};

using ConfigArray = std::vector<ConfigValue>;
using ConfigTable = std::vector<ConfigEntry>;  // in the order of the file

struct ConfigValue {
  std::variant<bool, std::int64_t, double, std::string, ConfigArray, ConfigTable> value;
  ConfigPosition position;

  bool is_table() const { return std::holds_alternative<ConfigTable>(value); }
  bool is_array() const { return std::holds_alternative<ConfigArray>(value); }
};

struct ConfigEntry {
  std::string key;
  ConfigPosition key_position;
  ConfigValue value;
};

// The root table of a text. `name` is the file's name for messages. Throws Error(usage) with
// `name:line:column` on a syntax error, more than 1 MiB of text or more than 100 levels of nesting.
// Dates and times are returned as strings.
ConfigValue parse_config(std::string_view text, const std::string& name);
// Reads the file first; Error(input) if it is missing. Its size is checked before it is read.
ConfigValue read_config(const std::string& path);
// The value of one `key = value` right-hand side, as for --set: TOML syntax, else a bare word as a
// string.
ConfigValue parse_config_value(std::string_view text, const std::string& name);

// `name:line:column`, or `name` alone for a value without a position.
std::string config_where(const std::string& name, ConfigPosition position);
// Throws Error(usage) at the position of the value.
[[noreturn]] void refuse_value(const ConfigValue& value, const std::string& name, std::string found,
                               std::string allowed);
// Describes a value for messages: "the string \"abc\"", "the number 3", "a table" …
std::string describe(const ConfigValue& value);
// How a path with control characters was read, for messages: "\"data\new.tif\" was read as …";
// empty for a path without.
std::string misread_path(std::string_view path);
// Advice how to write a backslash that is meant as one.
std::string backslash_advice();
// The candidate closest to `word` by edit distance, or an empty string if none is close.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);
// "; did you mean \"…\"?" with that candidate, for the end of a message; or an empty string.
std::string nearest_word_hint(std::string_view word, const std::vector<std::string>& candidates);

// Strict access for small documents (legends, palettes, rules). Each throws Error(usage) with
// position, finding and allowed type.
const ConfigTable& as_table(const ConfigValue& value, const std::string& name);
const ConfigArray& as_array(const ConfigValue& value, const std::string& name);
const std::string& as_string(const ConfigValue& value, const std::string& name);
// A string that is a path: also throws for control characters, which "\n" in "data\new.tif"
// becomes.
const std::string& as_path(const ConfigValue& value, const std::string& name);
double as_number(const ConfigValue& value, const std::string& name);
double as_number(const ConfigValue& value, const std::string& name, double min, double max);
// An array of so many.
std::vector<double> as_numbers(const ConfigValue& value, const std::string& name, std::size_t count,
                               double min, double max);
std::int64_t as_integer(const ConfigValue& value, const std::string& name);
bool as_bool(const ConfigValue& value, const std::string& name);
std::vector<std::string> as_strings(const ConfigValue& value, const std::string& name);
// The value of that key, or null.
const ConfigValue* find(const ConfigTable& table, std::string_view key);
// The value of that key of a table; Error(usage) with `allowed` if it is missing.
const ConfigValue& required(const ConfigValue& table, std::string_view key, const std::string& name,
                            const std::string& allowed);
// Error(usage) for the first key that is not in `allowed`, with the closest known one.
void allow_only(const ConfigTable& table, const std::vector<std::string>& allowed,
                const std::string& name);

}  // namespace belvedere
