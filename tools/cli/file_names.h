#pragma once

#include <string>

namespace belvedere::tools {

// Without its folders, so that messages and headers are the same wherever files are.
std::string file_name(const std::string& path);

}  // namespace belvedere::tools
