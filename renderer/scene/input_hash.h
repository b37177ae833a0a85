#pragma once

#include <cstdint>
#include <string>

namespace belvedere {

// What a file is known by.
struct InputHash {
  std::uint64_t bytes = 0;  // its size
  std::string hash;         // hash_file of its bytes
};

// Of a file that a scene reads, by its path or, where servers may be asked, its address: that is then read whole, once a process.
// Error(input) where it cannot be read.
InputHash hash_input(const std::string& path);

}  // namespace belvedere
