#include "base/config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/text/letters.h"

// In this version some malformed texts trigger the library's own assertions, which would end the
// program or, compiled out, be undefined behaviour. Thrown as exceptions they become syntax errors.
// (The library's mode without exceptions reaches more of these assertions.)
namespace belvedere {
struct BrokenAssertion {};
[[noreturn]] static void break_assertion() { throw BrokenAssertion(); }
}  // namespace belvedere
#undef NDEBUG
#define TOML_ASSERT(expression)                      \
  do {                                               \
    if (!(expression)) belvedere::break_assertion(); \
  } while (false)
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

namespace belvedere {
namespace {

constexpr std::size_t max_bytes = std::size_t{1} << 20;
constexpr int max_nesting = 100;

[[noreturn]] void refuse_nesting(const std::string& name, ConfigPosition position) {
  throw Error(ErrorKind::usage, config_where(name, position),
              "tables and arrays are nested too deeply",
              fmt::format("at most {} levels", max_nesting));
}

// Scans the raw text for the depth of brackets and dotted keys. The library recurses when it reads
// and frees tables, and a key such as a.a.a.a… nests without any bracket, so depth is bounded
// before parsing. The scan counts a few levels too many at most, hence the slack; convert() below
// is exact. On text that is not TOML the scan agrees with the library up to the first error, where
// the library stops.
class NestingScan {
 public:
  NestingScan(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  void run() {
    while (i_ < text_.size()) {
      const char c = text_[i_];
      if (c == '\n') {
        if (levels_.size() == 1) levels_.back() = {};
        ++line_;
        line_start_ = i_ + 1;
      } else if (c == '#') {
        i_ = std::min(text_.find('\n', i_), text_.size());
        continue;
      } else if (c == '"' || c == '\'') {
        skip_string(c);
        continue;
      } else if (c == '[' || c == '{') {
        // A bracket before the "=" is a table's header; its dots are those of a key.
        levels_.push_back({.dots = 0, .in_key = c == '{' || levels_.back().in_key});
      } else if ((c == ']' || c == '}') && levels_.size() > 1) {
        depth_ -= levels_.back().dots;
        levels_.pop_back();
      } else if (c == ',') {
        depth_ -= std::exchange(levels_.back().dots, 0);
        levels_.back().in_key = levels_.back().table;
      } else if (c == '=') {
        levels_.back().in_key = false;
      } else if (c == '.' && levels_.back().in_key) {
        ++levels_.back().dots;
        ++depth_;
      }
      if (c == '{') levels_.back().table = true;
      if (c == '\n' && levels_.size() == 1) depth_ = 0;
      if (depth_ + static_cast<int>(levels_.size()) > max_nesting + slack)
        refuse_nesting(name_, {line_, static_cast<int>(i_ - line_start_) + 1});
      ++i_;
    }
  }

 private:
  struct Level {
    int dots = 0;
    bool in_key = true;
    bool table = false;
  };
  static constexpr int slack = 8;

  void skip_string(char quote) {
    const std::string fence(3, quote);
    const bool many_lines = text_.substr(i_, 3) == fence;
    i_ += many_lines ? 3 : 1;
    while (i_ < text_.size()) {
      if (many_lines && text_.substr(i_, 3) == fence) {
        i_ += 3;
        return;
      }
      if (!many_lines && (text_[i_] == quote || text_[i_] == '\n')) {
        i_ += text_[i_] == quote ? 1 : 0;
        return;
      }
      if (text_[i_] == '\n') {
        ++line_;
        line_start_ = i_ + 1;
      }
      i_ += quote == '"' && text_[i_] == '\\' ? 2 : 1;
    }
  }

  std::string_view text_;
  const std::string& name_;
  std::vector<Level> levels_ = {Level{}};
  std::size_t i_ = 0;
  std::size_t line_start_ = 0;
  int line_ = 1;
  int depth_ = 0;  // total number of dots in all open levels
};

ConfigPosition position_of(const toml::source_region& source) {
  return {static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

ConfigValue convert(const toml::node& node, const std::string& name, int depth) {
  ConfigValue out{.value = false, .position = position_of(node.source())};
  if (depth > max_nesting) refuse_nesting(name, out.position);
  if (const auto* table = node.as_table()) {
    ConfigTable entries;
    for (const auto& [key, value] : *table)
      entries.push_back(
          {std::string(key.str()), position_of(key.source()), convert(value, name, depth + 1)});
    // The library sorts by name; messages and listings follow the order of the file.
    std::stable_sort(entries.begin(), entries.end(),
                     [](const ConfigEntry& a, const ConfigEntry& b) {
                       return std::pair(a.key_position.line, a.key_position.column) <
                              std::pair(b.key_position.line, b.key_position.column);
                     });
    out.value = std::move(entries);
  } else if (const auto* array = node.as_array()) {
    ConfigArray values;
    for (const auto& value : *array) values.push_back(convert(value, name, depth + 1));
    out.value = std::move(values);
  } else if (const auto* text = node.as_string()) {
    out.value = text->get();
  } else if (const auto* integer = node.as_integer()) {
    out.value = std::int64_t{integer->get()};
  } else if (const auto* number = node.as_floating_point()) {
    out.value = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    out.value = flag->get();
  } else {
    std::ostringstream moment;  // a date or time: ISO 8601 text
    moment.imbue(std::locale::classic());
    if (const auto* date = node.as_date()) moment << date->get();
    if (const auto* time = node.as_time()) moment << time->get();
    if (const auto* both = node.as_date_time()) moment << both->get();
    out.value = moment.str();
  }
  return out;
}

// Makes the library's sentences fit into ours: no final full stop or line break.
std::string tidy(std::string_view message) {
  std::string out(message);
  std::replace(out.begin(), out.end(), '\n', ' ');
  return out;
}

// An assertion has no position. Only texts that contain the bad line trigger it, so the line is
// found by bisection.
int line_of_broken_assertion(std::string_view text) {
  std::vector<std::size_t> ends;  // of the lines
  for (std::size_t i = text.find('\n'); i != std::string_view::npos; i = text.find('\n', i + 1))
    ends.push_back(i + 1);
  ends.push_back(text.size());
  const auto breaks = [&](std::size_t end) {
    try {
      static_cast<void>(toml::parse(text.substr(0, end)));
    } catch (const toml::parse_error&) {
      return false;
    } catch (const BrokenAssertion&) {
      return true;
    }
    return false;
  };
  const auto first =
      std::partition_point(ends.begin(), ends.end(), [&](std::size_t end) { return !breaks(end); });
  return static_cast<int>(first - ends.begin()) + 1;
}

void forget_places(ConfigValue& value) {
  value.position = {};
  if (auto* table = std::get_if<ConfigTable>(&value.value)) {
    for (ConfigEntry& entry : *table) {
      entry.key_position = {};
      forget_places(entry.value);
    }
  } else if (auto* array = std::get_if<ConfigArray>(&value.value)) {
    for (ConfigValue& element : *array) forget_places(element);
  }
}

// The part of a user's text that a message shows: short, on one line, without control characters.
std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string out = "\"";
  for (const char c : text.substr(0, longest)) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    out += control ? '?' : c;
  }
  return out + (text.size() > longest ? "…\"" : "\"");
}

// Edit distance with swaps of neighbouring letters as one edit (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), row(b.size() + 1);
  std::iota(previous.begin(), previous.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min(
          {previous[j] + 1, row[j - 1] + 1, previous[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = std::exchange(previous, row);
  }
  return previous[b.size()];
}

[[noreturn]] void wrong_type(const ConfigValue& value, const std::string& name,
                             const std::string& allowed) {
  throw Error(ErrorKind::usage, config_where(name, value.position), "found " + describe(value),
              allowed);
}

template <class T>
const T& as(const ConfigValue& value, const std::string& name, const std::string& allowed) {
  const T* found = std::get_if<T>(&value.value);
  if (found == nullptr) wrong_type(value, name, allowed);
  return *found;
}

void check_size(std::uintmax_t bytes, const std::string& name) {
  if (bytes > max_bytes)
    throw Error(ErrorKind::usage, name, fmt::format("longer than {} bytes", max_bytes),
                "at most 1 MiB of text");
}

}  // namespace

ConfigValue parse_config(std::string_view text, const std::string& name) {
  check_size(text.size(), name);
  NestingScan(text, name).run();
  const auto refuse = [&](ConfigPosition position, const std::string& found) {
    throw Error(ErrorKind::usage, config_where(name, position), found,
                "TOML 1.0 (https://toml.io)");
  };
  toml::table table;
  try {
    table = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    refuse(position_of(error.source()), tidy(error.description()));
  } catch (const BrokenAssertion&) {
    refuse({line_of_broken_assertion(text), 1}, "cannot parse this line");
  }
  ConfigValue root = convert(table, name, 0);
  root.position = {1, 1};
  return root;
}

ConfigValue read_config(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw Error(ErrorKind::input, path, "file not found");
  if (std::filesystem::is_directory(path, ignored))
    throw Error(ErrorKind::input, path, "is a folder", "a TOML file");
  if (std::filesystem::is_regular_file(path, ignored))
    check_size(std::filesystem::file_size(path, ignored), path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorKind::input, path, "cannot open the file", "a readable file");
  // Pipes and devices have no size: read at most one byte more than allowed.
  std::string text(max_bytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) throw Error(ErrorKind::input, path, "cannot read the file");
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parse_config(text, path);
}

ConfigValue parse_config_value(std::string_view text, const std::string& name) {
  check_size(text.size(), name);
  const std::size_t first = text.find_first_not_of(" \t");
  const bool structured = first != std::string_view::npos &&
                          std::string_view("\"'[{").find(text[first]) != std::string_view::npos;
  if (text.find_first_of("\r\n") != std::string_view::npos)
    throw Error(ErrorKind::usage, name, "the value " + in_quotes(text) + " has more than one line",
                "one value");
  if (!structured) {
    // A bare word (summer, EPSG:32632, my dem.tif) is not TOML and stands for itself. No text at
    // all is the empty string.
    try {
      if (toml::parse("v = " + std::string(text)).size() != 1)
        return {.value = std::string(text), .position = {}};
    } catch (const toml::parse_error&) {
      return {.value = std::string(text), .position = {}};
    } catch (const BrokenAssertion&) {
      return {.value = std::string(text), .position = {}};
    }
  }
  ConfigValue root;
  try {
    root = parse_config("v = " + std::string(text), name);
  } catch (const Error& error) {  // its position refers to "v = …", not to the input
    throw Error(error.kind(), name,
                "the value " + in_quotes(text) + " is not valid: " + error.found(),
                error.allowed());
  }
  ConfigValue value = std::get<ConfigTable>(root.value).front().value;
  forget_places(value);
  return value;
}

std::string config_where(const std::string& name, ConfigPosition position) {
  return position.line > 0 ? fmt::format("{}:{}:{}", name, position.line, position.column) : name;
}

std::string describe(const ConfigValue& value) {
  struct Visitor {
    std::string operator()(bool b) const { return b ? "true" : "false"; }
    std::string operator()(std::int64_t i) const { return fmt::format("the number {}", i); }
    std::string operator()(double d) const {
      return std::isnan(d) ? "not a number (nan)" : fmt::format("the number {}", d);
    }
    std::string operator()(const std::string& s) const { return "the string " + in_quotes(s); }
    std::string operator()(const ConfigArray& a) const {
      return fmt::format("an array of {}", a.size());
    }
    std::string operator()(const ConfigTable&) const { return "a table"; }
  };
  return std::visit(Visitor{}, value.value);
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 64;  // no key is nearly as long; bounds the cost
  if (word.empty() || word.size() > longest) return {};
  const std::string given = lower_case(std::string(word));
  std::string best;
  std::size_t best_distance =
      std::max<std::size_t>(2, word.size() / 3 + 1);  // from here on it is not a typing error
  for (const std::string& candidate : candidates) {
    const std::string known = lower_case(candidate);
    // A missing or extra unit (pitch_deg for pitch) is a small error, however long it is.
    const bool same_stem = given.starts_with(known + "_") || known.starts_with(given + "_");
    const std::size_t distance = same_stem ? 1 : edit_distance(given, known);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

const ConfigTable& as_table(const ConfigValue& value, const std::string& name) {
  return as<ConfigTable>(value, name, "a table");
}
const ConfigArray& as_array(const ConfigValue& value, const std::string& name) {
  return as<ConfigArray>(value, name, "an array");
}
const std::string& as_string(const ConfigValue& value, const std::string& name) {
  return as<std::string>(value, name, "a string");
}
bool as_bool(const ConfigValue& value, const std::string& name) {
  return as<bool>(value, name, "true or false");
}
std::int64_t as_integer(const ConfigValue& value, const std::string& name) {
  return as<std::int64_t>(value, name, "a whole number");
}

double as_number(const ConfigValue& value, const std::string& name) {
  if (const auto* integer = std::get_if<std::int64_t>(&value.value))
    return static_cast<double>(*integer);
  const double number = as<double>(value, name, "a number");
  if (!std::isfinite(number)) wrong_type(value, name, "a finite number");
  return number;
}

const ConfigValue* find(const ConfigTable& table, std::string_view key) {
  const auto entry =
      std::find_if(table.begin(), table.end(), [&](const ConfigEntry& e) { return e.key == key; });
  return entry == table.end() ? nullptr : &entry->value;
}

void allow_only(const ConfigTable& table, const std::vector<std::string>& allowed,
                const std::string& name) {
  for (const ConfigEntry& entry : table) {
    if (std::find(allowed.begin(), allowed.end(), entry.key) != allowed.end()) continue;
    const std::string near = nearest_word(entry.key, allowed);
    throw Error(ErrorKind::usage, config_where(name, entry.key_position),
                "unknown key " + in_quotes(entry.key) +
                    (near.empty() ? "" : "; did you mean \"" + near + "\"?"),
                fmt::format("{}", fmt::join(allowed, ", ")));
  }
}

void refuse_value(const ConfigValue& value, const std::string& name, std::string found,
                  std::string allowed) {
  throw Error(ErrorKind::usage, config_where(name, value.position), std::move(found),
              std::move(allowed));
}

}  // namespace belvedere
