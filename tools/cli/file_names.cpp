#include "tools/cli/file_names.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "base/text/missing_file.h"
#include "renderer/image/image_io.h"
#include "terrain/io/http_access.h"

namespace belvedere::tools {

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

void check_place(const std::string& path) {
  if (path.empty()) return;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  check_output_folder(folder.empty() ? "." : folder);
}

void check_exists(const std::string& path, const std::string& option) {
  std::error_code ignored;
  if (path.empty() || is_address(path) || std::filesystem::exists(path, ignored)) return;
  const Error missing = missing_file(path);
  throw Error(missing.kind(), option, path + ": " + missing.found(), "an existing file");
}

void check_exist(const std::vector<std::string>& paths, const std::string& option) {
  for (const std::string& path : paths) check_exists(path, option);
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
