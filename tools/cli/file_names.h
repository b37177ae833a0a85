#pragma once

#include <string>
#include <vector>

namespace belvedere::tools {

// Without its folders: what is told and stored is the same wherever files lie.
std::string file_name(const std::string& path);
// Tries the folder of a result before the work begins: Error(output). An empty path is none.
void check_place(const std::string& path);
// Error(usage) where a result, which `option` names, is one of the files that are read, by whatever path.
void check_not_read(const std::string& result, const std::string& option, const std::vector<std::string>& read);

}  // namespace belvedere::tools
