#pragma once

#include <cstddef>
#include <vector>

namespace belvedere {

// Asks the system to hold a block of memory in pages of 2 MiB instead of 4 KiB. For large tables that are read here and there: a processor
// remembers where some thousand pages lie and asks memory for the others, which takes as long as the reading. Changes nothing but time;
// without effect where the system does not know such pages.
void prefer_large_pages(const void* begin, std::size_t bytes);
template <class T>
void prefer_large_pages(const std::vector<T>& values) {
  prefer_large_pages(values.data(), values.size() * sizeof(T));
}
// So many equal values in a vector that is held so. The system is asked before they are written: it then clears large pages at once instead
// of small ones that it would move afterwards.
template <class T>
void assign_in_large_pages(std::vector<T>& values, std::size_t count, T value) {
  values.clear();
  values.reserve(count);
  prefer_large_pages(values.data(), count * sizeof(T));
  values.assign(count, value);
  prefer_large_pages(values);
}

}  // namespace belvedere
