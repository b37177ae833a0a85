#pragma once

#include <atomic>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace belvedere {

// Memory whose bits are all zero. A large block comes from the system, which clears a page when it
// is first written, so the threads that fill a grid also fault in its pages and nothing is cleared
// twice. It requests large pages: with pages of 4 KiB the faults alone took a tenth of a picture's
// time. Throws std::bad_alloc.
void* allocate_zeroed(std::size_t bytes);
// bytes: the number requested.
void free_zeroed(void* memory, std::size_t bytes) noexcept;
// Lets the C library keep freed memory for the next grids instead of returning it to the system at
// once: faulting in and clearing the same pages again took a third of a picture's time. For
// programs, at their start; up to 256 MiB stay allocated.
void reuse_freed_memory();
// Returns to the system what is kept, after work that is not repeated soon.
void return_freed_memory();
// For tests that count allocations: called with the size of each block, negative when it is freed.
extern std::atomic<void (*)(std::ptrdiff_t bytes)> zeroed_memory_observer;

// Allocator for std::vector: a default-constructed element of a type without initializers is left
// as the memory is, which is zero. A vector of `lent` memory, which must hold all its elements and
// outlive it, has them as they are and never frees them; moving it moves the loan, copies have
// memory of their own.
template <class T>
class ZeroedAllocator {
 public:
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  ZeroedAllocator() = default;
  explicit ZeroedAllocator(T* lent) : lent_(lent) {}
  template <class U>
  explicit(false) ZeroedAllocator(const ZeroedAllocator<U>&) {}

  T* allocate(std::size_t count) {
    static_assert(alignof(T) <= alignof(std::max_align_t));
    if (lent_ != nullptr) return lent_;
    if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_zeroed(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    if (memory != lent_) free_zeroed(memory, count * sizeof(T));
  }
  ZeroedAllocator select_on_container_copy_construction() const { return {}; }

  template <class U, class... Arguments>
  void construct(U* position, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) > 0 || !std::is_trivially_default_constructible_v<U>)
      ::new (static_cast<void*>(position)) U(std::forward<Arguments>(arguments)...);
  }

  bool operator==(const ZeroedAllocator&) const = default;

 private:
  T* lent_ = nullptr;
};

// Copies and fills of large blocks by all threads: the first write to a page of new memory waits
// until the system has cleared it, which takes longer than the copy. The caller does small blocks
// alone. The caller's threads take up no other work meanwhile, so a lock may be held.

// The two blocks must not overlap.
void copy_in_parallel(void* to, const void* from, std::size_t bytes);
// `count` values of `value_bytes` each, one after the other.
void fill_in_parallel(void* to, const void* value, std::size_t value_bytes, std::size_t count);

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
