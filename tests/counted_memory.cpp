#include "tests/counted_memory.h"

#include <malloc.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "base/memory/sanitized.h"
#include "base/memory/zeroed_memory.h"

namespace belvedere::test {
namespace {

std::atomic<bool> counting{false};
std::atomic<std::ptrdiff_t> held{0};
std::atomic<std::ptrdiff_t> peak{0};

void count(std::ptrdiff_t bytes) {
  if (!counting.load(std::memory_order_relaxed)) return;
  const std::ptrdiff_t now = held.fetch_add(bytes) + bytes;
  std::ptrdiff_t max = peak.load();
  while (now > max && !peak.compare_exchange_weak(max, now)) {
  }
}

// The sanitizers have their own operators.
#ifndef BELVEDERE_SANITIZED
#define BELVEDERE_COUNTS_NEW
void* counted_new(std::size_t bytes) {
  void* memory = std::malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  count(static_cast<std::ptrdiff_t>(malloc_usable_size(memory)));
  return memory;
}

void counted_delete(void* memory) noexcept {
  if (memory != nullptr) count(-static_cast<std::ptrdiff_t>(malloc_usable_size(memory)));
  std::free(memory);
}
#endif

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

}  // namespace belvedere::test

#ifdef BELVEDERE_COUNTS_NEW
void* operator new(std::size_t bytes) { return belvedere::test::counted_new(bytes); }
void operator delete(void* memory) noexcept { belvedere::test::counted_delete(memory); }
void operator delete(void* memory, std::size_t) noexcept {
  belvedere::test::counted_delete(memory);
}
#endif
