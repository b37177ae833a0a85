#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.h"

namespace belvedere {

// Where the parts of a TOML text stand, so that one can be replaced and all others stay as they
// are.

// {"deform", "handles", "0", "move_m"}: elements of lists are counted from 0.
using TomlPath = std::vector<std::string>;

struct TextSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
};

struct TomlPart {
  enum class Kind {
    blank,
    comment,  // alone on its line
    header,   // [table]
    element,  // [[list]]
    value,    // key = value below a header
    item,     // of an array or of an inline table
  };
  Kind kind = Kind::blank;
  TomlPath path;             // whole, with indices
  TomlPath table;            // of the header above a value
  TextSpan whole;            // lines with their breaks; of an item: key and value
  TextSpan key;              // empty for headers and for elements of arrays
  TextSpan value;            // empty for headers
  bool has_comment = false;  // at the end of its line
  std::size_t holder = 0;    // of an item: index of the array or inline table around it
};

// All parts in their order. The text must be valid TOML: what is not is skipped, not reported.
std::vector<TomlPart> toml_layout(std::string_view text);

// Whether `path` is `above` or lies in it.
bool lies_in(const TomlPath& path, const TomlPath& above);
TomlPath first_of(const TomlPath& path, std::size_t count);
// The table or list around.
TomlPath above(const TomlPath& path);

// One name of a key, in quotation marks where it needs them.
std::string toml_key(std::string_view name);
// On one line.
std::string toml_text(const ConfigValue& value);

}  // namespace belvedere
