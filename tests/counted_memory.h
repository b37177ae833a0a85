#pragma once

#include <cstddef>

namespace belvedere::test {

// Counts the bytes that the program allocates while this object exists, with new and for grids.
// Unlike resident memory the count does not depend on other programs or on what earlier tests left
// in the heap. Only one may exist at a time.
class CountedMemory {
 public:
  CountedMemory();
  ~CountedMemory();
  CountedMemory(const CountedMemory&) = delete;
  CountedMemory& operator=(const CountedMemory&) = delete;

  // The highest number of bytes allocated at the same time, beyond those at the beginning.
  std::size_t peak_bytes() const;
};

// Lets one allocation fail: the n-th from now on, with new or for grids, counted from 1. 0: none,
// they are only counted. For a process that ends afterwards.
void fail_allocation(std::size_t n);
// Since then.
std::size_t allocations();

}  // namespace belvedere::test
