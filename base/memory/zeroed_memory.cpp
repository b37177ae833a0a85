#include "base/memory/zeroed_memory.h"

#include <malloc.h>
#include <sys/mman.h>

#include <cstdlib>

#include "base/memory/sanitized.h"

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

}  // namespace belvedere
