#include "terrain/io/csv.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/text/missing_file.h"
#include "base/text/text_encoding.h"

namespace belvedere {
namespace {

std::string trimmed(std::string_view text) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return std::string(text);
}

bool equal_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char p, char q) {
    return std::tolower(static_cast<unsigned char>(p)) ==
           std::tolower(static_cast<unsigned char>(q));
  });
}

char find_separator(std::string_view text) {
  const std::string_view header = text.substr(0, text.find('\n'));
  char best = ',';
  for (const char c : {';', '\t'})
    if (std::count(header.begin(), header.end(), c) >
        std::count(header.begin(), header.end(), best))
      best = c;
  return best;
}

// The separator of a first line "sep=;", which tells spreadsheets what follows, and skips the line;
// 0 if there is none.
char skip_separator_line(std::string_view& text, int& line) {
  const std::size_t end = text.find('\n');
  std::string first = trimmed(text.substr(0, end));
  if (first.size() > 1 && first.front() == '"' && first.back() == '"')
    first = first.substr(1, first.size() - 2);
  const bool tab = equal_letters(first, "sep=");  // a tab was trimmed
  if (!tab && (first.size() != 5 || !equal_letters(first.substr(0, 4), "sep="))) return '\0';
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  ++line;
  return tab ? '\t' : first.back();
}

// One record from `at` on, which is advanced behind it; `line` counts its lines.
std::vector<std::string> read_record(std::string_view text, std::size_t& at, int& line,
                                     char separator, const std::string& name) {
  std::vector<std::string> fields;
  std::string field;
  bool quoted = false;  // inside of quotes
  bool was_quoted = false;
  const int first_line = line;
  const auto finish = [&] {
    fields.push_back(was_quoted ? field : trimmed(field));
    field.clear();
    was_quoted = false;
  };
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\n') ++line;
    if (quoted) {
      if (c != '"')
        field += c;
      else if (at + 1 < text.size() && text[at + 1] == '"')
        field += text[++at];
      else
        quoted = false;
    } else if (c == '"' && trimmed(field).empty() && !was_quoted) {
      field.clear();
      quoted = was_quoted = true;
    } else if (c == separator) {
      finish();
    } else if (c == '\n') {
      ++at;
      finish();
      return fields;
    } else if (c != '\r' && !(was_quoted && std::isspace(static_cast<unsigned char>(c)) != 0)) {
      field += c;
    }
  }
  if (quoted)
    throw Error(ErrorKind::usage, fmt::format("{}:{}", name, first_line), "unclosed quote");
  finish();
  return fields;
}

}  // namespace

int CsvTable::find(std::string_view column) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const std::string& c) { return equal_letters(c, column); });
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

int CsvTable::find_any(const std::vector<std::string_view>& names) const {
  for (const std::string_view candidate : names)
    if (const int column = find(candidate); column >= 0) return column;
  return -1;
}

CsvTable parse_csv(std::string_view text, const std::string& name) {
  text = require_utf8(text, name, "the key `encoding` of its block in the scene", ErrorKind::input);
  CsvTable table;
  table.name = name;
  int line = 1;
  char separator = skip_separator_line(text, line);
  if (separator == '\0') separator = find_separator(text);
  std::size_t at = 0;
  while (at < text.size()) {
    const int first_line = line;
    std::vector<std::string> fields = read_record(text, at, line, separator, name);
    if (std::all_of(fields.begin(), fields.end(),
                    [](const std::string& field) { return field.empty(); }))
      continue;
    if (table.columns.empty()) {
      table.columns = std::move(fields);
      continue;
    }
    if (fields.size() > table.columns.size()) {
      throw Error(ErrorKind::usage, fmt::format("{}:{}", name, first_line),
                  fmt::format("has {} fields", fields.size()),
                  fmt::format("{} fields, as in the header; quote fields that contain separators",
                              table.columns.size()));
    }
    fields.resize(table.columns.size());
    table.rows.push_back({first_line, std::move(fields)});
  }
  return table;
}

CsvTable read_csv(const std::string& path, const std::string& encoding) {
  constexpr std::uintmax_t max_bytes = 16U << 20;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) throw missing_file(path, "a .csv file");
  if (std::filesystem::file_size(path, ignored) > max_bytes)
    throw Error(ErrorKind::limit, path, "file too large", "at most 16 MiB");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorKind::input, path, "cannot open the file");
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) throw Error(ErrorKind::input, path, "cannot read the file");
  return parse_csv(encoding.empty() ? text.str() : text_to_utf8(text.str(), encoding, path), path);
}

}  // namespace belvedere
