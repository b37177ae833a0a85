#pragma once

#include <string>

namespace belvedere {

// "a zip archive", "a gzip archive" …, by the first bytes of a file: downloads often come packed.
// Empty for anything else, and for files that cannot be read.
std::string archive_kind(const std::string& path);

// For messages: what to do with an archive.
inline constexpr const char* unpack_advice = "unpack it, and name the file within";

}  // namespace belvedere
