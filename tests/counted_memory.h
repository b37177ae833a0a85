#pragma once

#include <cstddef>

namespace belvedere::test {

// Counts the bytes that the program asks for while it lives: by new, and for grids. Not what the system grants: other tests, threads and
// programs do not change the count. One at a time.
class CountedMemory {
 public:
  CountedMemory();
  ~CountedMemory();
  CountedMemory(const CountedMemory&) = delete;
  CountedMemory& operator=(const CountedMemory&) = delete;

  // The most that was held at a time, beyond what was held at the beginning.
  std::size_t peak_bytes() const;
};

}  // namespace belvedere::test
