#pragma once

#include <string>

namespace belvedere {

// "a zip archive", "a gzip archive" …, from the first bytes of a file; downloads are often packed.
// Empty for anything else, and for files that cannot be read.
std::string archive_kind(const std::string& path);

// For messages: what to do with an archive.
inline constexpr const char* unpack_advice = "unpack it and give the path of the file inside";

}  // namespace belvedere
