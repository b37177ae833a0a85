#include "tests/counted_memory.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "base/memory/zeroed_memory.h"

namespace belvedere::test {
namespace {

std::atomic<bool> counting{false};
std::atomic<std::ptrdiff_t> held{0};
std::atomic<std::ptrdiff_t> peak{0};

std::atomic<bool> failing{false};
std::atomic<std::size_t> allocated{0};
std::atomic<std::size_t> failing_at{0};

void count_allocation() {
  if (!failing.load(std::memory_order_relaxed)) return;
  if (allocated.fetch_add(1) + 1 == failing_at.load()) throw std::bad_alloc();
}
void count_grid(std::ptrdiff_t bytes) {
  if (bytes > 0) count_allocation();
}

void count(std::ptrdiff_t bytes) {
  if (!counting.load(std::memory_order_relaxed)) return;
  const std::ptrdiff_t now = held.fetch_add(bytes) + bytes;
  std::ptrdiff_t max = peak.load();
  while (now > max && !peak.compare_exchange_weak(max, now)) {
  }
}

void* counted_new(std::size_t bytes) {
  count_allocation();
  void* memory = std::malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  count(static_cast<std::ptrdiff_t>(malloc_usable_size(memory)));
  return memory;
}

void counted_delete(void* memory) noexcept {
  if (memory != nullptr) count(-static_cast<std::ptrdiff_t>(malloc_usable_size(memory)));
  std::free(memory);
}

}  // namespace

CountedMemory::CountedMemory() {
  held = 0;
  peak = 0;
  counting = true;
  zeroed_memory_observer = count;
}

CountedMemory::~CountedMemory() {
  zeroed_memory_observer = nullptr;
  counting = false;
}

std::size_t CountedMemory::peak_bytes() const { return static_cast<std::size_t>(peak.load()); }

void fail_allocation(std::size_t n) {
  allocated = 0;
  failing_at = n;
  failing = true;
  zeroed_memory_observer = count_grid;
}

std::size_t allocations() { return allocated.load(); }

}  // namespace belvedere::test

void* operator new(std::size_t bytes) { return belvedere::test::counted_new(bytes); }
void operator delete(void* memory) noexcept { belvedere::test::counted_delete(memory); }
void operator delete(void* memory, std::size_t) noexcept {
  belvedere::test::counted_delete(memory);
}
