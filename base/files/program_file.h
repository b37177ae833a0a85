#pragma once

#include <string>

namespace belvedere {

// The file that holds the code of the library: the running program; a module that a host such as
// Python loads names itself before it calls anything. Its folder has the fonts of an installation,
// its bytes tell one build from another in the cache.
inline std::string& program_file() {
  static std::string path = "/proc/self/exe";
  return path;
}

}  // namespace belvedere
