#pragma once

#include <string>

#include "base/error.h"

namespace belvedere {

// An existing path that differs from a missing one only in upper and lower case or in how letters
// with accents are stored (composed or decomposed), in any of its folders; empty if there is none.
std::string similar_path(const std::string& path);
// For messages: "; there is "Dem.tif", …", with the difference in words, or nothing.
std::string similar_path_hint(const std::string& path);

// Error(input) for a path that does not exist, with what exists nearly under its name.
// found: what is said of it before.
Error missing_file(const std::string& path, const std::string& allowed = {},
                   const std::string& found = "file not found");
// Throws it unless the path is a file (pipes and devices are).
void require_file(const std::string& path, const std::string& allowed = {});

// "a zip archive", "a gzip archive" …, from the first bytes of a file; downloads are often packed.
// Empty for anything else, and for files that cannot be read.
std::string archive_kind(const std::string& path);

// For messages: what to do with an archive.
inline constexpr const char* unpack_advice = "unpack it and give the path of the file inside";

}  // namespace belvedere
