#pragma once

#include <string>

namespace belvedere::tools {

// A folder of the run's own in the system's place for such things ($TMPDIR), gone with the object.
class ScratchFolder {
 public:
  // Error(output) where none can be made.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace belvedere::tools
