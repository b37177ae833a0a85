#pragma once

#include <string>
#include <string_view>

#include "renderer/style/style.h"

namespace belvedere {

// Writes a style as TOML: the tables of a palette (data/palettes), then
// [brushwork.CLASS] and [sky_grid]. Colours are "#rrggbb" in encoded sRGB; residuals are L, a, b in
// thousandths; numbers have three digits after the point.
std::string style_text(const Style& style);
// Strict: Error(usage) with file:line:column for unknown keys, wrong types and values out of range.
// `name` is the file's name in messages. Brushwork and sky that the file omits stay empty; the
// palette may be based on a built-in one.
Style parse_style(std::string_view text, const std::string& name);
// Built-in name ("segantini"; data/styles/*.toml) or a .toml file.
Style read_style(const std::string& name_or_path);

}  // namespace belvedere
