#pragma once

#include <string>

namespace belvedere {

// A temporary folder of the run in the system's usual location ($TMPDIR), removed with the object.
class ScratchFolder {
 public:
  // Error(output) where it cannot be created.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace belvedere
