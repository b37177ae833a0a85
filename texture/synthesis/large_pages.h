#pragma once

#include <cstddef>
#include <vector>

namespace belvedere {

// Asks the system to hold a block of memory in pages of 2 MiB instead of 4 KiB, for large tables
// with random access: the TLB covers about a thousand pages, and a miss takes as long as the read
// itself. Affects only speed; no effect where the system has no such pages.
void prefer_large_pages(const void* begin, std::size_t bytes);
template <class T>
void prefer_large_pages(const std::vector<T>& values) {
  prefer_large_pages(values.data(), values.size() * sizeof(T));
}
// A vector of equal values, held in this way. The request comes before they are written: the system
// then clears large pages at once instead of small ones that it would move afterwards.
template <class T>
void assign_in_large_pages(std::vector<T>& values, std::size_t count, T value) {
  values.clear();
  values.reserve(count);
  prefer_large_pages(values.data(), count * sizeof(T));
  values.assign(count, value);
  prefer_large_pages(values);
}

}  // namespace belvedere
