#pragma once

#include <string>

namespace belvedere {

// Error(usage) that names `path` for an encoding that is not known ("windows-1252", "ISO-8859-1"
// and whatever else iconv knows).
void check_text_encoding(const std::string& encoding, const std::string& path);

// Text in an encoding as UTF-8. Throws as check_text_encoding; Error(input) for bytes that are no
// text in it.
std::string text_to_utf8(const std::string& text, const std::string& encoding,
                         const std::string& path);

}  // namespace belvedere
