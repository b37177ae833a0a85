#include "texture/synthesis/large_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace belvedere {
namespace {

constexpr std::uintptr_t large_page = std::uintptr_t{2} << 20;
constexpr std::size_t worth_asking = std::size_t{4} << 20;
// Since Linux 6.1, in newer headers MADV_COLLAPSE: already written small pages are moved into large
// ones at once.
constexpr int collapse = 25;

}  // namespace

void prefer_large_pages(const void* begin, std::size_t bytes) {
  if (bytes < worth_asking) return;
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + large_page - 1) / large_page * large_page;
  const std::uintptr_t last = (address + bytes) / large_page * large_page;
  // A hint: if the system ignores it, nothing changes.
  void* const block = reinterpret_cast<void*>(first);
  if (::madvise(block, last - first, MADV_HUGEPAGE) == 0) ::madvise(block, last - first, collapse);
}

}  // namespace belvedere
