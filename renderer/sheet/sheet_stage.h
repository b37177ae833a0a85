#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "renderer/sheet/tile_store.h"

namespace belvedere {

// One product of the sheet. It exists only where somebody looks: the tiles that a rectangle touches are made then, each once, and kept.
// `Product` is a value with grids; `planes(product)` lists them, `blank(width, height)` makes one of a size.
template <class Product>
class SheetStage {
 public:
  struct Making {
    std::function<Product(PixelRect)> make;  // a tile of the sheet
    std::function<Product(int, int)> blank;  // a product without values
    std::function<Planes(Product&)> planes;  // its grids; those that are empty have no values
  };
  SheetStage(TileStore::Place& place, int sheet_width, int sheet_height, int tile_px, Making making)
      : sheet_{0, 0, sheet_width, sheet_height},
        making_(std::move(making)),
        store_(place, sheet_width, sheet_height, tile_px, value_bytes()) {
    tile_px_ = tile_px;
  }

  // A rectangle of the sheet; it is cut where it reaches beyond.
  Product read(PixelRect rect) {
    Product out = making_.blank(rect.width(), rect.height());
    read_into(rect, making_.planes(out));
    return out;
  }
  // The same into some of the grids: planes in the order of the product's, those without values are left out.
  void read_into(PixelRect rect, const Planes& wanted) {
    for (int row = rect.y0 / tile_px_; row <= (rect.y1 - 1) / tile_px_; ++row)
      for (int column = rect.x0 / tile_px_; column <= (rect.x1 - 1) / tile_px_; ++column) {
        if (!store_.has(column, row)) {
          Product tile = making_.make(store_.rect(column, row));
          store_.put(column, row, making_.planes(tile));
        }
        store_.get(column, row, intersection(rect, store_.rect(column, row)), rect.x0, rect.y0, wanted);
      }
  }
  // Forgets tiles that touch nothing of `still`: the part of the sheet that will yet be asked for.
  void keep_only(PixelRect still) {
    for (int row = 0; row < store_.down(); ++row)
      for (int column = 0; column < store_.across(); ++column)
        if (intersection(still, store_.rect(column, row)).empty()) store_.drop(column, row);
  }
  PixelRect sheet() const { return sheet_; }

 private:
  std::vector<std::size_t> value_bytes() const {
    Product sample = making_.blank(1, 1);
    std::vector<std::size_t> bytes;
    for (const Plane& plane : making_.planes(sample)) bytes.push_back(plane.value_bytes);
    return bytes;
  }

  PixelRect sheet_;
  Making making_;
  TileStore store_;
  int tile_px_ = 0;
};

}  // namespace belvedere
