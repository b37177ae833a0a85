#pragma once

#include <cstdint>
#include <string>

namespace belvedere {

// Bytes that the program may use: what the strictest MemoryLimit alive says, else $BELVEDERE_MEMORY_MIB where it is set to a number, else
// three quarters of what the machine has (or of what its control group allows, where that is less).
std::uint64_t memory_budget_bytes();

// Limits the bytes that the program may use while it lives; 0 limits nothing. Like ThreadLimit it holds for the whole process, so that
// whatever reads a file meets it without being told.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::uint64_t bytes);
  ~MemoryLimit();
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  std::uint64_t bytes_;
};

// Error(limit) naming `where` and both figures if `bytes` are more than the limit. To be called before allocating anything
// whose size comes from a file or a scene; `bytes` in double so that products of wild sizes cannot wrap around.
void check_memory(const std::string& where, double bytes);

}  // namespace belvedere
