#pragma once

#include <string>
#include <vector>

namespace belvedere::tools {

// Without its folders, so that messages and headers are the same wherever files are.
std::string file_name(const std::string& path);
// Checks the folder of a result before the work begins: Error(output). An empty path is skipped.
void check_place(const std::string& path);
// Error(input) that names the option where its file does not exist, before the work begins. Empty
// paths and addresses are skipped.
void check_exists(const std::string& path, const std::string& option);
void check_exist(const std::vector<std::string>& paths, const std::string& option);
// Error(usage) where a result, named by `option`, is one of the input files, by whatever path.
void check_not_read(const std::string& result, const std::string& option,
                    const std::vector<std::string>& read);

}  // namespace belvedere::tools
