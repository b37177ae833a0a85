#pragma once

#include <string>

namespace belvedere::tools {

// Without its folders: what is told and stored is the same wherever files lie.
std::string file_name(const std::string& path);
// The ending of a file name in small letters, with its point.
std::string ending_of(const std::string& path);
// Tries the folder of a result before the work begins: Error(output). An empty path is none.
void check_place(const std::string& path);

}  // namespace belvedere::tools
