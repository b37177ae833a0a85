#include "tools/cli/file_names.h"

#include <algorithm>
#include <filesystem>

#include "renderer/image/image_io.h"

namespace belvedere::tools {

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return ending;
}

void check_place(const std::string& path) {
  if (path.empty()) return;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  check_output_folder(folder.empty() ? "." : folder);
}

}  // namespace belvedere::tools
