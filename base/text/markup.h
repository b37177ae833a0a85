#pragma once

#include <map>
#include <string>
#include <string_view>

namespace belvedere {

// Text between the tags of a page or an SVG file, or in an attribute. What XML 1.0 cannot hold at all, as control characters, becomes a
// blank.
std::string markup_text(std::string_view text);

// JSON as it may stand in a page's script: no text in it ends the script or begins another.
std::string script_json(std::string_view json);

// A page from its template: {word} becomes the text of that word, which is put in as it is.
std::string filled_page(std::string_view page, const std::map<std::string, std::string>& texts);

}  // namespace belvedere
