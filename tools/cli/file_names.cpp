#include "tools/cli/file_names.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "renderer/image/image_io.h"

namespace belvedere::tools {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

void check_place(const std::string& path) {
  if (path.empty()) return;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  check_output_folder(folder.empty() ? "." : folder);
}

void check_not_read(const std::string& result, const std::string& option,
                    const std::vector<std::string>& read) {
  for (const std::string& path : read) {
    std::error_code ignored;  // files that do not exist are never the same
    if (std::filesystem::equivalent(path, result, ignored))
      throw Error(ErrorKind::usage, option, result + " is also an input", "another file name");
  }
}

}  // namespace belvedere::tools
