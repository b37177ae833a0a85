#pragma once

#include <string>
#include <string_view>

namespace belvedere {

// Text between the tags of a page or an SVG file, or in an attribute. What XML 1.0 cannot hold at all, as control characters, becomes a
// blank.
std::string markup_text(std::string_view text);

}  // namespace belvedere
