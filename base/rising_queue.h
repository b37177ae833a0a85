#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace belvedere {

// A key that sorts by a float and, where these are equal, by an index.
inline std::uint64_t rising_key(float value, std::uint32_t index) {
  const auto bits = std::bit_cast<std::uint32_t>(value + 0.F);  // no negative zero
  const std::uint32_t ordered = (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
  return static_cast<std::uint64_t>(ordered) << 32 | index;
}

// Smallest key first, in exactly the order of a binary heap, for floods, whose keys nearly always
// grow. Far keys are kept unsorted by the highest bit in which they differ from the current ones,
// and are sorted, a few at a time, when their turn comes (after the radix heap of Ahuja, Mehlhorn,
// Orlin & Tarjan 1990). So the heap fits in the first-level cache, however wide the front is.
class RisingQueue {
 public:
  bool empty() const { return near_.empty() && filled_ == 0; }

  void push(std::uint64_t key) {
    if (key <= last_near_) {
      near_.push_back(key);
      std::push_heap(near_.begin(), near_.end(), std::greater<>());
      return;
    }
    const int bit = 63 - std::countl_zero(key ^ last_near_);
    far_[static_cast<std::size_t>(bit)].push_back(key);
    filled_ |= std::uint64_t{1} << bit;
  }

  // Only if not empty.
  std::uint64_t pop() {
    while (near_.empty()) bring_near();
    std::pop_heap(near_.begin(), near_.end(), std::greater<>());
    const std::uint64_t key = near_.back();
    near_.pop_back();
    return key;
  }

 private:
  void bring_near() {
    constexpr std::size_t max_sorted = 128;
    const int bit = std::countr_zero(filled_);
    std::vector<std::uint64_t>& next = far_[static_cast<std::size_t>(bit)];
    filled_ &= ~(std::uint64_t{1} << bit);
    if (next.size() <= max_sorted) {
      // All of them agree from this bit on: no farther key comes before the end of their range.
      last_near_ = next[0] | ((std::uint64_t{1} << bit) - 1);
      near_.swap(next);
      std::make_heap(near_.begin(), near_.end(), std::greater<>());
      return;
    }
    last_near_ = *std::min_element(next.begin(), next.end());
    std::vector<std::uint64_t> keys;
    keys.swap(next);
    for (const std::uint64_t key : keys) push(key);
    keys.clear();
    if (next.empty()) next.swap(keys);  // reuses the memory
  }

  std::vector<std::uint64_t> near_;  // a heap of all keys up to last_near_
  std::array<std::vector<std::uint64_t>, 64>
      far_;                   // by the highest bit that differs from last_near_
  std::uint64_t filled_ = 0;  // which of them are not empty
  std::uint64_t last_near_ = 0;
};

}  // namespace belvedere
