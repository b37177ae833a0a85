#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <utility>

#include "base/parallel.h"
#include "renderer/graph/planes.h"

namespace belvedere {

// How the executor handles the product of a stage: a value with grids.
template <class Product>
struct ProductFormat {
  std::function<Product(int width, int height)> blank;  // without values
  std::function<Planes(Product&)> planes;               // its grids; empty ones have no values
  double bytes_per_pixel() const {
    Product sample = blank(1, 1);
    double bytes = 0.0;
    for (const Plane& plane : planes(sample))
      bytes += plane.values == nullptr ? 0.0 : static_cast<double>(plane.value_bytes);
    return bytes;
  }
};

// A product of some of a struct's grids; the others stay empty. All are allocated together and
// first written by all threads, because page faults take longer than filling.
template <class Product, class... Grids>
std::function<Product(int, int)> with_grids(Grids Product::*... grids) {
  return [grids...](int width, int height) {
    Product product;
    const auto maker = [&](auto grid) {
      return std::function<void()>([&product, grid, width, height] {
        product.*grid = std::decay_t<decltype(product.*grid)>(width, height);
      });
    };
    const std::array<std::function<void()>, sizeof...(Grids)> make = {maker(grids)...};
    parallel_ranges(make.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) make[i]();
    });
    return product;
  };
}

// A struct whose grids are these.
template <class Product, class... Grids>
ProductFormat<Product> grids_of(Grids Product::*... grids) {
  return {.blank = with_grids(grids...),
          .planes = [grids...](Product& product) { return Planes{plane_of(product.*grids)...}; }};
}

// One grid.
template <class Grid>
ProductFormat<Grid> one_grid() {
  return {.blank = [](int width, int height) { return Grid(width, height); },
          .planes = [](Grid& grid) { return Planes{plane_of(grid)}; }};
}

// A value that is never kept in tiles.
template <class Product>
ProductFormat<Product> untiled() {
  return {.blank = [](int, int) { return Product(); }, .planes = [](Product&) { return Planes(); }};
}

}  // namespace belvedere
