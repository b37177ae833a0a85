#include "base/text/embedded.h"

#include <algorithm>

#include "base/error.h"

namespace belvedere {

std::string_view embedded_file(std::string_view name) {
  for (unsigned i = 0; i < embedded_file_count; ++i)
    if (name == embedded_files[i].name) return embedded_files[i].text;
  throw Error(ErrorKind::bug, std::string(name), "this file is not built into the program");
}

std::vector<std::string> embedded_names(std::string_view folder) {
  std::vector<std::string> names;
  for (unsigned i = 0; i < embedded_file_count; ++i) {
    const std::string_view name = embedded_files[i].name;
    if (!name.starts_with(folder) || name.size() <= folder.size() || name[folder.size()] != '/')
      continue;
    const std::string_view rest = name.substr(folder.size() + 1);
    names.emplace_back(rest.substr(0, rest.rfind('.')));
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace belvedere
