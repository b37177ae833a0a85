#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/grid.h"
#include "base/memory/zeroed_memory.h"
#include "base/parallel.h"

namespace belvedere {

// Values as bytes and back, for this machine and this build: for caches and scratch files, not for
// exchange. A type of several fields lists them once for reading and writing, by structured
// binding, so that a new field cannot be forgotten:
//   void each_field(auto& bytes, FieldsOf<Dem> auto& dem) {
//     auto& [altitude_m, filled, transform, crs] = dem;
//     bytes(altitude_m, filled, transform, crs);
//   }
template <class T, class Value>
concept FieldsOf = std::is_same_v<std::remove_const_t<T>, Value>;

// Not cleared twice when it grows: large ones come zeroed from the system.
using Bytes = std::vector<std::byte, ZeroedAllocator<std::byte>>;

template <class T>
concept PlainBytes = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

// Collects parts without copying grids and texts: the values written must outlive the parts.
class ByteWriter {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  const std::vector<std::span<const std::byte>>& parts() const { return parts_; }
  std::uint64_t size() const;

 private:
  void add(const void* bytes, std::size_t count);
  void put_number(std::uint64_t number);
  template <class T>
  void put(const T& value) {
    if constexpr (PlainBytes<T>)
      add(&value, sizeof value);
    else
      each_field(*this, value);
  }
  void put(const std::string& text) {
    put_number(text.size());
    add(text.data(), text.size());
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put_number(values.size());
    if constexpr (PlainBytes<T>)
      add(values.data(), values.size() * sizeof(T));
    else
      for (const T& value : values) put(value);
  }
  template <PlainBytes T>
  void put(const Grid<T>& grid) {
    put_number(static_cast<std::uint64_t>(grid.width()));
    put_number(static_cast<std::uint64_t>(grid.height()));
    add(grid.data(), grid.size() * sizeof(T));
  }

  std::vector<std::span<const std::byte>> parts_;
  std::deque<std::uint64_t> numbers_;  // a deque: addresses stay valid
};

// Reads the same values in the same order. If the bytes end too early, the remaining values stay
// empty and is_done() is false.
class ByteReader {
 public:
  // Gives the next bytes; false where there are none.
  using Source = FunctionRef<bool(void* to, std::size_t count)>;

  explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes), left_(bytes.size()) {}
  // From a file of so many bytes: large values are read without a copy of their bytes. `source`
  // must outlive the reader.
  ByteReader(const Source& source, std::uint64_t bytes) : source_(&source), left_(bytes) {}
  template <class... T>
  void operator()(T&... values) {
    (take(values), ...);
  }
  // Whether everything requested was there and nothing is left.
  bool is_done() const { return !failed_ && left_ == 0; }

 private:
  bool copy(void* to, std::size_t count);
  std::uint64_t take_number();
  template <class T>
  void take(T& value) {
    if constexpr (PlainBytes<T>)
      copy(&value, sizeof value);
    else
      each_field(*this, value);
  }
  void take(std::string& text) {
    const std::uint64_t size = take_number();
    if (!has(size, 1)) return;
    text.resize(size);
    copy(text.data(), text.size());
  }
  template <class T>
  void take(std::vector<T>& values) {
    const std::uint64_t size = take_number();
    if (!has(size, PlainBytes<T> ? sizeof(T) : 1)) return;
    values.resize(size);
    if constexpr (PlainBytes<T>)
      copy(values.data(), size * sizeof(T));
    else
      for (T& value : values) take(value);
  }
  template <PlainBytes T>
  void take(Grid<T>& grid) {
    const std::uint64_t width = take_number();
    const std::uint64_t height = take_number();
    if (width > largest_side || height > largest_side || !has(width * height, sizeof(T))) {
      failed_ = true;
      return;
    }
    grid = width * height == 0 ? Grid<T>()
                               : Grid<T>(static_cast<int>(width), static_cast<int>(height));
    copy(grid.data(), grid.size() * sizeof(T));
  }
  // Checked before memory of a size that was read is allocated.
  bool has(std::uint64_t count, std::uint64_t bytes_each);

  static constexpr std::uint64_t largest_side = INT32_MAX;
  const Source* source_ = nullptr;
  std::span<const std::byte> rest_;  // without a source
  std::uint64_t left_ = 0;
  bool failed_ = false;
};

}  // namespace belvedere
