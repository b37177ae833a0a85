#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/grid.h"
#include "base/land_cover_class.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere::python {

// The number that a cell consists of, and how many of them.
template <class T>
using NumberOf =
    std::conditional_t<std::is_same_v<T, Rgb8> || std::is_same_v<T, LandCoverClass>, std::uint8_t,
                       std::conditional_t<std::is_same_v<T, Match>, std::uint16_t,
                                          std::conditional_t<std::is_same_v<T, glm::vec2> ||
                                                                 std::is_same_v<T, glm::vec3>,
                                                             float, T>>>;
template <class T>
constexpr auto numbers_of = static_cast<pybind11::ssize_t>(sizeof(T) / sizeof(NumberOf<T>));
template <class T>
constexpr bool is_vector = sizeof(T) != sizeof(NumberOf<T>);

// (height, width), or (height, width, numbers of a cell).
template <class T>
using ArrayOf = pybind11::array_t<NumberOf<T>, pybind11::array::c_style>;

// An array that owns the grid's memory.
template <class T>
pybind11::array array_of(Grid<T> grid) {
  auto kept = std::make_unique<Grid<T>>(std::move(grid));
  std::vector<pybind11::ssize_t> shape = {kept->height(), kept->width()};
  if constexpr (is_vector<T>) shape.push_back(numbers_of<T>);
  const auto* numbers = reinterpret_cast<const NumberOf<T>*>(kept->data());
  const pybind11::capsule owner(kept.release(),
                                [](void* memory) { delete static_cast<Grid<T>*>(memory); });
  return ArrayOf<T>(shape, numbers, owner);
}

// A grid that reads the array's memory and must not outlive it. belvedere/_arrays.py makes such
// arrays of what callers give.
template <class T>
Grid<T> lent(const ArrayOf<T>& array) {
  constexpr pybind11::ssize_t dimensions = is_vector<T> ? 3 : 2;
  if (array.ndim() != dimensions || (dimensions == 3 && array.shape(2) != numbers_of<T>))
    throw Error(ErrorKind::usage, "array", "has another number of dimensions or values");
  return Grid<T>::lent(reinterpret_cast<const T*>(array.data()), static_cast<int>(array.shape(1)),
                       static_cast<int>(array.shape(0)));
}

}  // namespace belvedere::python
