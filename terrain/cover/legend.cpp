#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "base/config.h"
#include "base/error.h"
#include "base/text/config_reader.h"
#include "base/text/missing_file.h"
#include "base/text/parse_number.h"
#include "base/text/text_encoding.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/csv.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

std::string class_names() { return fmt::format("{}", fmt::join(ground_class_names(), ", ")); }

LandCoverClass parse_class(const std::string& name, const std::string& where) {
  if (const std::optional<LandCoverClass> found = find_ground_class(name)) return *found;
  throw Error(ErrorKind::usage, where, fmt::format("unknown class \"{}\"", name), class_names());
}

std::optional<std::int32_t> parse_code(std::string_view text) {
  const std::optional<std::int32_t> code = parse_number<std::int32_t>(text);
  return code.value_or(-1) < 0 ? std::nullopt : code;
}

void add_entry(Legend& legend, std::int32_t code, Legend::Entry entry, const std::string& where) {
  if (legend.entries.contains(code))
    throw Error(ErrorKind::usage, where, fmt::format("duplicate code {}", code));
  legend.entries.emplace(code, std::move(entry));
}

// * matches any run of characters, ? any single one; case-insensitive.
bool matches(std::string_view pattern, std::string_view text) {
  // Greedy with one level of backtracking: whenever the rest does not match, the last star takes
  // one more character.
  std::size_t p = 0, t = 0, star = std::string_view::npos, star_text = 0;
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      star_text = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || lower(pattern[p]) == lower(text[t]))) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++star_text;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

constexpr const char* code_columns = "code, value, grid_value, raster_value, id";

int code_column(const CsvTable& table) {
  return table.find_any({"code", "value", "grid_value", "raster_value", "id"});
}
int label_column(const CsvTable& table) {
  return table.find_any(
      {"label", "name", "descriptive_name", "description", "class_name", "class_names"});
}

int required_column(const CsvTable& table, const std::string& column, const std::string& where) {
  const int found = table.find(column);
  if (found >= 0) return found;
  throw Error(ErrorKind::usage, where,
              fmt::format("{} has no column \"{}\"{}", table.name, column,
                          nearest_word_hint(column, table.columns)),
              fmt::format("{}", fmt::join(table.columns, ", ")));
}

std::int32_t code_of(const CsvTable& table, const CsvTable::Row& row, int column) {
  const std::string& text = row.fields[static_cast<std::size_t>(column)];
  if (const std::optional<std::int32_t> code = parse_code(text)) return *code;
  throw Error(ErrorKind::usage, fmt::format("{}:{}", table.name, row.line),
              fmt::format("invalid code \"{}\"", text), "a whole number, 0 or more");
}

// A CSV file alone: a column of codes and a column of painted classes, optionally one of labels.
Legend legend_from_csv(const std::string& path) {
  const CsvTable table = read_csv(path);
  const int codes = code_column(table);
  const int classes = table.find_any({"class", "painted_as", "painted_class"});
  const int labels = label_column(table);
  if (codes < 0) throw Error(ErrorKind::usage, path + ":1", "no column of codes", code_columns);
  if (classes < 0) {
    throw Error(ErrorKind::usage, path + ":1",
                "no column \"class\" with the painted class of each code",
                fmt::format("a column class ({}), or a legend in TOML that names this file and "
                            "maps its words (docs/legends.md)",
                            class_names()));
  }
  Legend legend;
  legend.name = fs::path(path).stem().string();
  for (const CsvTable::Row& row : table.rows) {
    const std::string where = fmt::format("{}:{}", path, row.line);
    const LandCoverClass painted_as =
        parse_class(row.fields[static_cast<std::size_t>(classes)], where);
    add_entry(legend, code_of(table, row, codes),
              {labels < 0 ? "" : row.fields[static_cast<std::size_t>(labels)], painted_as}, where);
  }
  return legend;
}

// The codes table of a TOML legend: 11 = "water", or 11 = { label = "Open water", class = "water",
// also = [12, 13] }.
void add_codes(Legend& legend, const ConfigValue& codes, const std::string& name) {
  for (const ConfigEntry& entry : as_table(codes, name)) {
    const std::string where = config_where(name, entry.key_position);
    const std::optional<std::int32_t> code = parse_code(entry.key);
    if (!code)
      throw Error(ErrorKind::usage, where, fmt::format("invalid code \"{}\"", entry.key),
                  "a whole number, 0 or more");
    if (!entry.value.is_table()) {
      add_entry(
          legend, *code,
          {"", parse_class(as_string(entry.value, name), config_where(name, entry.value.position))},
          where);
      continue;
    }
    const ConfigTable& table = as_table(entry.value, name);
    allow_only(table, {"label", "class", "also"}, name);
    const ConfigValue* painted_as = find(table, "class");
    if (painted_as == nullptr)
      throw Error(ErrorKind::usage, where, "class missing", "class = … (" + class_names() + ")");
    const ConfigValue* label = find(table, "label");
    const Legend::Entry made{
        label != nullptr ? as_string(*label, name) : "",
        parse_class(as_string(*painted_as, name), config_where(name, painted_as->position))};
    add_entry(legend, *code, made, where);
    const ConfigValue* also = find(table, "also");
    if (also == nullptr) continue;
    const ConfigArray one = also->is_array() ? ConfigArray{} : ConfigArray{*also};
    for (const ConfigValue& other : also->is_array() ? as_array(*also, name) : one) {
      const std::int64_t value = as_integer(other, name);
      if (value < 0 || value > INT32_MAX)
        throw Error(ErrorKind::usage, config_where(name, other.position),
                    fmt::format("invalid code {}", value), "0…2147483647");
      add_entry(legend, static_cast<std::int32_t>(value), made, config_where(name, other.position));
    }
  }
}

// A file that a legend names, in the legend's own folder or one of the others. The name must not
// lead out of them.
std::string find_beside(const std::string& file, const std::vector<std::string>& folders,
                        const std::string& where) {
  const fs::path path = fs::path(file).lexically_normal();
  if (file.empty() || path.is_absolute() || path.begin()->string() == "..") {
    throw Error(ErrorKind::usage, where, fmt::format("\"{}\"", file),
                "a file in the legend's folder or in a subfolder");
  }
  std::string looked, hint;
  for (const std::string& folder : folders) {
    const fs::path here = fs::path(folder.empty() ? "." : folder) / path;
    std::error_code ignored;
    if (!fs::is_regular_file(here, ignored)) {
      looked += (looked.empty() ? "" : ", ") + here.string();
      if (hint.empty()) hint = similar_path_hint(here.string());
      continue;
    }
    // Links must not lead out either.
    const fs::path root = fs::weakly_canonical(folder.empty() ? "." : folder, ignored);
    const fs::path inside = fs::weakly_canonical(here, ignored).lexically_relative(root);
    if (inside.empty() || inside.begin()->string() == "..")
      throw Error(ErrorKind::usage, where,
                  fmt::format("\"{}\" leads out of {}", file, root.string()));
    return here.string();
  }
  throw Error(ErrorKind::input, where, fmt::format("file not found: \"{}\"{}", file, hint),
              "a file in one of " + looked);
}

// The rows of a CSV file, mapped by patterns over its words: the first pattern that matches any of
// the columns wins.
void add_csv_rows(Legend& legend, const ConfigTable& root, const std::string& name,
                  const std::vector<std::string>& folders) {
  const ConfigValue& file = *find(root, "csv");
  const CsvTable table =
      read_csv(find_beside(as_path(file, name), folders, config_where(name, file.position)));
  const auto column = [&](const char* key, int inferred) {
    const ConfigValue* value = find(root, key);
    return value == nullptr ? inferred
                            : required_column(table, as_string(*value, name),
                                              config_where(name, value->position));
  };
  const int codes = column("code", code_column(table));
  const int labels = column("label", label_column(table));
  if (codes < 0)
    throw Error(
        ErrorKind::usage, name,
        fmt::format("{} has no column of codes with a usual name ({})", table.name, code_columns),
        "code = \"name of the column\"");
  std::vector<int> searched;
  if (const ConfigValue* match = find(root, "match")) {
    const ConfigArray one = match->is_array() ? ConfigArray{} : ConfigArray{*match};
    for (const ConfigValue& value : match->is_array() ? as_array(*match, name) : one)
      searched.push_back(
          required_column(table, as_string(value, name), config_where(name, value.position)));
  } else if (labels >= 0) {
    searched.push_back(labels);
  }
  const ConfigValue* map = find(root, "map");
  if (map == nullptr || searched.empty())
    throw Error(ErrorKind::usage, name, "the rows of the CSV file are not mapped to classes",
                "match = [\"a column\"] and a table [map] of \"pattern\" = \"class\"");
  struct Pattern {
    std::string text;
    LandCoverClass painted_as;
  };
  std::vector<Pattern> patterns;
  for (const ConfigEntry& entry : as_table(*map, name)) {
    patterns.push_back({entry.key, parse_class(as_string(entry.value, name),
                                               config_where(name, entry.value.position))});
  }
  for (const CsvTable::Row& row : table.rows) {
    const std::int32_t code = code_of(table, row, codes);
    if (legend.entries.contains(code) || legend.nodata.contains(code))
      continue;  // codes of the legend itself take precedence
    const auto fits = [&](const Pattern& pattern) {
      return std::any_of(searched.begin(), searched.end(), [&](int c) {
        return matches(pattern.text, row.fields[static_cast<std::size_t>(c)]);
      });
    };
    const auto pattern = std::find_if(patterns.begin(), patterns.end(), fits);
    // No pattern matches: the code stays out of the legend, and is an error only if the raster has
    // it.
    if (pattern == patterns.end()) continue;
    legend.entries.emplace(
        code, Legend::Entry{labels < 0 ? "" : row.fields[static_cast<std::size_t>(labels)],
                            pattern->painted_as});
  }
}

Legend legend_from_toml(const ConfigValue& value, const std::string& name,
                        const std::vector<std::string>& folders) {
  const ConfigTable& root = as_table(value, name);
  allow_only(root, {"name", "nodata", "codes", "csv", "code", "label", "match", "map"}, name);
  Legend legend;
  const ConfigValue* title = find(root, "name");
  legend.name = title != nullptr ? as_string(*title, name) : fs::path(name).stem().string();
  if (const ConfigValue* nodata = find(root, "nodata"))
    for (const ConfigValue& code : as_array(*nodata, name))
      legend.nodata.insert(static_cast<std::int32_t>(
          std::clamp<std::int64_t>(as_integer(code, name), -1, INT32_MAX)));
  if (const ConfigValue* codes = find(root, "codes")) add_codes(legend, *codes, name);
  if (find(root, "csv") != nullptr)
    add_csv_rows(legend, root, name, folders);
  else
    for (const char* key : {"code", "label", "match", "map"})
      if (const ConfigValue* stray = find(root, key))
        throw Error(ErrorKind::usage, config_where(name, stray->position),
                    fmt::format("`{}` without `csv`", key));
  if (legend.entries.empty())
    throw Error(ErrorKind::usage, name, "the legend has no codes",
                "a table [codes], or csv with [map]");
  return legend;
}

}  // namespace

Legend read_legend(const std::string& name_or_path, const std::vector<std::string>& folders) {
  if (lower_extension(name_or_path) == ".csv") return legend_from_csv(name_or_path);
  const NamedConfig read = read_named_config("legends", name_or_path, "legend");
  std::vector<std::string> positions = {fs::path(name_or_path).parent_path().string()};
  positions.insert(positions.end(), folders.begin(), folders.end());
  return legend_from_toml(read.root, read.name, positions);
}

}  // namespace belvedere
