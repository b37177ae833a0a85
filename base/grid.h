#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <glm/vec3.hpp>
#include <type_traits>
#include <vector>

#include "base/memory/zeroed_memory.h"
#include "base/parallel.h"

namespace belvedere {

// A width × height array of values, row-major, row 0 on top, without geography (see Raster). x is
// the column, y the row. Indices are not checked in release builds.
template <class T>
class Grid {
 public:
  using value_type = T;

  Grid() = default;
  Grid(int width, int height, const T& fill = T{})
      : width_(width),
        height_(height),
        values_(filled(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill)) {}
  Grid(const Grid& other)
      : width_(other.width_), height_(other.height_), values_(copied(other.values_)) {}
  Grid(Grid&&) noexcept = default;
  Grid& operator=(const Grid& other) {
    if (this != &other) *this = Grid(other);
    return *this;
  }
  Grid& operator=(Grid&&) noexcept = default;
  ~Grid() = default;

  // A grid of values that lie in memory of somebody else, which must outlive it: for functions that
  // read it. Nothing is copied; a copy of the grid has memory of its own.
  static Grid lent(const T* values, int width, int height) {
    static_assert(plain);
    Grid out;
    out.width_ = width;
    out.height_ = height;
    const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (size > 0) out.values_ = Values(size, ZeroedAllocator<T>(const_cast<T*>(values)));
    return out;
  }

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  template <class U>
  bool same_size(const Grid<U>& other) const {
    return width_ == other.width() && height_ == other.height();
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  T& operator()(int x, int y) { return values_[index(x, y)]; }
  const T& operator()(int x, int y) const { return values_[index(x, y)]; }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }

  // The value at the nearest position inside the grid: borders replicate.
  const T& clamped(int x, int y) const { return (*this)(within(x, width_), within(y, height_)); }

  T* row(int y) { return values_.data() + index(0, y); }
  const T* row(int y) const { return values_.data() + index(0, y); }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }

  auto begin() { return values_.begin(); }
  auto end() { return values_.end(); }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }

  bool operator==(const Grid&) const = default;

 private:
  // An index clamped to 0…count - 1; count is at least 1.
  static constexpr int within(int i, int count) { return i < 0 ? 0 : i < count ? i : count - 1; }

  using Values = std::vector<T, ZeroedAllocator<T>>;
  // Values for which new memory may stay uninitialized by a constructor: they are written as bytes.
  static constexpr bool plain =
      std::is_trivially_copyable_v<T> && std::is_trivially_default_constructible_v<T>;

  // A grid of zeros is not touched before it is filled.
  static Values filled(std::size_t size, const T& fill) {
    if constexpr (plain) {
      Values values(size);
      constexpr std::array<unsigned char, sizeof(T)> zeros{};
      if (std::memcmp(&fill, zeros.data(), sizeof(T)) != 0)
        fill_in_parallel(values.data(), &fill, sizeof(T), size);
      return values;
    } else {
      return Values(size, fill);
    }
  }
  static Values copied(const Values& from) {
    if constexpr (plain) {
      Values values(from.size());
      copy_in_parallel(values.data(), from.data(), sizeof(T) * from.size());
      return values;
    } else {
      return from;
    }
  }

  int width_ = 0;
  int height_ = 0;
  Values values_;
};

// The values of a rectangle of a grid, which must lie inside it.
template <class T>
Grid<T> part_of(const Grid<T>& grid, PixelRect rect) {
  Grid<T> part(rect.width(), rect.height());
  parallel_ranges(rect.height(), 64, [&](int begin, int end) {
    for (int y = begin; y != end; ++y)
      std::copy_n(grid.row(rect.y0 + y) + rect.x0, rect.width(), part.row(y));
  });
  return part;
}

// Copies a grid to where column x0 and row y0 of another begin; it must lie inside.
template <class T>
void copy_part(Grid<T>& whole, const Grid<T>& part, int x0, int y0) {
  parallel_ranges(part.height(), 64, [&](int begin, int end) {
    for (int y = begin; y != end; ++y)
      std::copy_n(part.row(y), part.width(), whole.row(y0 + y) + x0);
  });
}

// Scene-linear RGB with sRGB (Rec. 709) primaries; 1 is diffuse white.
using Image = Grid<glm::vec3>;

}  // namespace belvedere
