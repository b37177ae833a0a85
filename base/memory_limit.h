#pragma once

#include <cstdint>
#include <string>

namespace belvedere {

// Bytes that the program may use: the strictest MemoryLimit in effect, else $BELVEDERE_MEMORY_MIB
// if it is a number, else three quarters of the machine's memory (or of its control group's limit,
// if that is less).
std::uint64_t memory_budget_bytes();

// Limits the bytes that the program may use while it lives; 0 limits nothing. Like ThreadLimit it
// applies to the whole process, so that file readers need no parameter for it.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::uint64_t bytes);
  ~MemoryLimit();
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  std::uint64_t bytes_;
};

// Error(limit) with `where` and both figures if `bytes` exceed the limit. Call it before allocating
// anything whose size comes from a file or a scene. `bytes` is a double so that products of extreme
// sizes cannot overflow.
void check_memory(const std::string& where, double bytes);

}  // namespace belvedere
