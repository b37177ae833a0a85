#pragma once

#include <cstdint>
#include <string>

namespace belvedere {

// What identifies the content of a file.
struct InputHash {
  std::uint64_t bytes = 0;  // its size
  std::string hash;         // hash_file of its bytes
};

// For a file that a scene reads, by its path or, where servers may be asked, its address. A remote
// file is then downloaded whole, once per process. Error(input) where it cannot be read.
InputHash hash_input(const std::string& path);

}  // namespace belvedere
