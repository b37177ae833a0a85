#pragma once

#include <map>
#include <string>
#include <string_view>

namespace belvedere {

// Escapes text for the content or an attribute of a page or SVG file. Characters that XML 1.0
// cannot contain, such as control characters, become blanks.
std::string markup_text(std::string_view text);

// Escapes JSON for a page's script: no text in it ends the script or begins another.
std::string script_json(std::string_view json);

// Fills a template: {word} is replaced by the text of that word, without escaping.
std::string filled_page(std::string_view page, const std::map<std::string, std::string>& texts);

}  // namespace belvedere
