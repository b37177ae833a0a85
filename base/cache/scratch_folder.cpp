#include "base/cache/scratch_folder.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "base/error.h"

namespace belvedere {

ScratchFolder::ScratchFolder() {
  std::error_code problem;
  const std::filesystem::path position = std::filesystem::temp_directory_path(problem);
  if (problem)
    throw Error(ErrorKind::output, "TMPDIR", "no folder for temporary files: " + problem.message());
  path_ = (position / "belvedere-XXXXXX").string();
  if (::mkdtemp(path_.data()) == nullptr)
    throw Error(ErrorKind::output, position.string(),
                "cannot create a folder in it: " + std::generic_category().message(errno),
                "another folder, named by the variable TMPDIR");
}

ScratchFolder::~ScratchFolder() {
  try {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  } catch (const std::bad_alloc&) {  // a folder stays
  }
}

}  // namespace belvedere
