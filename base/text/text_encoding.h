#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.h"

namespace belvedere {

// The text without a byte order mark. Error(kind: usage, or input for data) with the line, the
// column and the byte where it is UTF-16, UTF-32 or of a code page, that is not UTF-8. `or_else`:
// what else is allowed, added to the advice to convert it.
std::string_view require_utf8(std::string_view text, const std::string& name,
                              const std::string& or_else = {}, ErrorKind kind = ErrorKind::usage);
// The part of it for UTF-16 and UTF-32, which needs only the beginning of a text.
void refuse_wide_text(std::string_view beginning, const std::string& name,
                      const std::string& or_else = {}, ErrorKind kind = ErrorKind::usage);

// Letters of a file's name without what file systems treat differently: composed and decomposed
// letters (é as one or two characters), upper and lower case. Empty if it is not UTF-8.
std::string folded_letters(const std::string& name);
// Whether both names have the same letters in the same case, composed or not.
bool same_letters(const std::string& a, const std::string& b);
// Whether letters with accents are one character each (NFC).
bool is_composed(const std::string& name);

// Error(usage) that names `path` for an encoding that is not known ("windows-1252", "ISO-8859-1"
// and whatever else iconv knows).
void check_text_encoding(const std::string& encoding, const std::string& path);

// Text in an encoding as UTF-8. Throws as check_text_encoding; Error(input) for bytes that are no
// text in it.
std::string text_to_utf8(const std::string& text, const std::string& encoding,
                         const std::string& path);

// ASCII letters A to Z in lower case, independent of the locale; other bytes unchanged.
std::string lower_case(std::string text);
// The extension of a file's name in lower case, with its point: ".tif".
std::string lower_extension(const std::string& path);
// A number in groups of three digits: "1 234 567".
std::string grouped(std::size_t number);

// Bytes as base64 and back (RFC 4648, section 4); nothing for malformed text.
std::string base64(std::string_view bytes);
std::optional<std::string> base64_bytes(std::string_view text);

// Text on one line and back: line feeds as \\n, backslashes doubled.
std::string on_one_line(std::string_view text);
std::string from_one_line(std::string_view line);

// Escapes text for the content or an attribute of a page or SVG file. Characters that XML 1.0
// cannot contain, such as control characters, become blanks.
std::string markup_text(std::string_view text);

// Escapes JSON for a page's script: no text in it ends the script or begins another.
std::string script_json(std::string_view json);

// Fills a template: {word} is replaced by the text of that word, without escaping.
std::string filled_page(std::string_view page, const std::map<std::string, std::string>& texts);

}  // namespace belvedere
