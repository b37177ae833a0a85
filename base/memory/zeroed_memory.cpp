#include "base/memory/zeroed_memory.h"

#include <malloc.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "base/memory/sanitized.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// Blocks from this size on come from the system. Below it, the C library reuses its own memory
// without a fault per page.
constexpr std::size_t large_block_bytes = std::size_t{16} << 20;

// The address sanitizer watches only the C library's blocks.
#ifdef BELVEDERE_ADDRESS_SANITIZER
constexpr bool from_system = false;
#else
constexpr bool from_system = true;
#endif

bool is_large(std::size_t bytes) { return from_system && bytes >= large_block_bytes; }

void observe(std::ptrdiff_t bytes) {
  if (auto* const observer = zeroed_memory_observer.load(std::memory_order_relaxed))
    observer(bytes);
}

}  // namespace

std::atomic<void (*)(std::ptrdiff_t bytes)> zeroed_memory_observer = nullptr;

void reuse_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the largest allowed
  // Threads share few arenas, because each keeps as much as the threshold.
  mallopt(M_ARENA_MAX, 4);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  mallopt(M_TOP_PAD, 16 << 20);
}

void return_freed_memory() { malloc_trim(0); }

void* allocate_zeroed(std::size_t bytes) {
  observe(static_cast<std::ptrdiff_t>(bytes));
  if (!is_large(bytes)) {
    void* memory = std::calloc(bytes, 1);
    if (memory == nullptr && bytes > 0) throw std::bad_alloc();
    return memory;
  }
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  madvise(memory, bytes, MADV_HUGEPAGE);  // only a hint: without large pages, pages stay small
  return memory;
}

void free_zeroed(void* memory, std::size_t bytes) noexcept {
  if (memory != nullptr) observe(-static_cast<std::ptrdiff_t>(bytes));
  if (is_large(bytes))
    munmap(memory, bytes);
  else
    std::free(memory);
}

namespace {

constexpr std::size_t min_bytes =
    std::size_t{16} << 20;  // the size from which blocks come from the system (zeroed_memory.cpp)
constexpr std::size_t share_bytes = std::size_t{4} << 20;  // per task: two large pages
constexpr std::size_t pattern_bytes = std::size_t{16} << 10;

// Calls f(begin, end) for shares of 0…bytes.
template <class F>
void share(std::size_t bytes, F&& f) {
  const std::size_t shares = (bytes + share_bytes - 1) / share_bytes;
  isolated([&] {
    parallel_ranges(shares, std::size_t{1}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i)
        f(i * share_bytes, std::min(bytes, (i + 1) * share_bytes));
    });
  });
}

}  // namespace

void copy_in_parallel(void* to, const void* from, std::size_t bytes) {
  if (bytes == 0) return;
  if (bytes < min_bytes) {
    std::memcpy(to, from, bytes);
    return;
  }
  share(bytes, [&](std::size_t begin, std::size_t end) {
    std::memcpy(static_cast<unsigned char*>(to) + begin,
                static_cast<const unsigned char*>(from) + begin, end - begin);
  });
}

void fill_in_parallel(void* to, const void* value, std::size_t value_bytes, std::size_t count) {
  if (count == 0 || value_bytes == 0) return;
  auto* const bytes = static_cast<unsigned char*>(to);
  const std::size_t total = value_bytes * count;
  // The pattern is a whole number of values; copies of it fill the rest.
  const std::size_t pattern =
      value_bytes * std::clamp<std::size_t>(pattern_bytes / value_bytes, 1, count);
  for (std::size_t at = 0; at < pattern; at += value_bytes)
    std::memcpy(bytes + at, value, value_bytes);
  const auto repeat = [&](std::size_t begin, std::size_t end) {
    while (begin < end) {
      const std::size_t within = begin % pattern;
      const std::size_t part = std::min(pattern - within, end - begin);
      if (begin >= pattern) std::memcpy(bytes + begin, bytes + within, part);
      begin += part;
    }
  };
  if (total < min_bytes)
    repeat(0, total);
  else
    share(total, repeat);
}

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
