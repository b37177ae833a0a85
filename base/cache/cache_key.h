#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/cache/content_hash.h"
#include "base/grid.h"

namespace belvedere {

// The inputs of a cached product as a text that is equal if and only if the values are: numbers to
// the last bit (hexadecimal floating point), texts with their length, grids by their size and the
// hash of their cells. Every input must be included, or the cache would change pixels. Take
// parameters apart by structured bindings, which name all fields or do not compile.
class CacheKeyText {
 public:
  template <class T>
  CacheKeyText& add(std::string_view name, const T& value) {
    text_ += name;
    text_ += '=';
    put(value);
    text_ += '\n';
    return *this;
  }
  const std::string& str() const { return text_; }

 private:
  void put(double number);
  void put(float number) { put(static_cast<double>(number)); }
  void put(bool is) { text_ += is ? "yes" : "no"; }
  void put(std::string_view text);
  void put(const std::string& text) { put(std::string_view(text)); }
  void put(const char* text) { put(std::string_view(text)); }
  template <std::integral T>
  void put(T number) {
    text_ += std::to_string(number);
  }
  template <class T>
  requires std::is_enum_v<T>
  void put(T value) { put(static_cast<std::int64_t>(value)); }
  template <glm::length_t size, class T, glm::qualifier q>
  void put(const glm::vec<size, T, q>& vector) {
    for (glm::length_t i = 0; i < size; ++i) put(vector[i]), text_ += ' ';
  }
  template <class A, class B>
  void put(const std::pair<A, B>& pair) {
    put(pair.first);
    text_ += ':';
    put(pair.second);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    if (value)
      put(*value);
    else
      text_ += "none";
  }
  template <class T, std::size_t size>
  void put(const std::array<T, size>& values) {
    put_list(values);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put_list(values);
  }
  template <class T>
  void put(const Grid<T>& grid) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>,
                  "equal cells must be equal bytes");
    put_grid(grid.width(), grid.height(),
             {reinterpret_cast<const char*>(grid.data()), grid.size() * sizeof(T)});
  }
  template <class List>
  void put_list(const List& values) {
    text_ += '[';
    for (const auto& value : values) put(value), text_ += ',';
    text_ += ']';
  }
  void put_grid(int width, int height, std::string_view cells);

  std::string text_;
};

}  // namespace belvedere
