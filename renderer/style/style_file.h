#pragma once

#include <string>
#include <string_view>

#include "renderer/style/style.h"

namespace belvedere {

// A style as TOML that people read and edit: the tables of a palette (data/palettes), then
// [brushwork.CLASS] and [sky_grid]. Colours are "#rrggbb" in encoded sRGB; residuals are L, a, b in
// thousandths; numbers have three digits after the point.
std::string style_text(const Style& style);
// Strict: Error(usage) with file:line:column for unknown keys, wrong types and values out of range.
// `name` stands for the file in messages. What is not said of brushwork and sky is not there;
// palettes may be based on a built-in one.
Style parse_style(std::string_view text, const std::string& name);
// Built-in name ("segantini"; data/styles/*.toml) or a .toml file.
Style read_style(const std::string& name_or_path);

}  // namespace belvedere
