#include "tools/cli/file_names.h"

#include <filesystem>

namespace belvedere::tools {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace belvedere::tools
