#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/sheet/tile_store.h"

namespace belvedere {

// The smallest rectangle around two; an empty one counts for nothing.
inline PixelRect around_both(const PixelRect& a, const PixelRect& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

// One product of the sheet. It exists only where somebody looks: the tiles that a rectangle touches are made then, each once, and kept. Of
// tiles at the border of what will be asked for in all (keep_only) the part inside it is made alone; a product must be the same in any
// rectangles. `Product` is a value with grids; `planes(product)` lists them, `blank(width, height)` makes one of a size.
template <class Product>
class SheetStage {
 public:
  struct Making {
    std::function<Product(PixelRect)> make;  // a tile of the sheet
    std::function<Product(int, int)> blank;  // a product without values
    std::function<Planes(Product&)> planes;  // its grids; those that are empty have no values
    bool whole_tiles = false;                // whether it is the same in its own tiles alone, not in any rectangles
  };
  SheetStage(TileStore::Place& place, int sheet_width, int sheet_height, int tile_px, Making making)
      : place_(place),
        sheet_{0, 0, sheet_width, sheet_height},
        still_(sheet_),
        making_(std::move(making)),
        store_(place, sheet_width, sheet_height, tile_px, value_bytes()) {
    tile_px_ = tile_px;
  }

  // Makes what a rectangle lacks. Whoever looks at several stages has all of them prepared before it takes memory of its own: otherwise
  // the windows of every stage behind would stand in memory around that of the first.
  void prepare(PixelRect rect) {
    visit_tiles(rect, [&](int column, int row, PixelRect part) { make_missing(column, row, part); });
  }
  // A rectangle of the sheet.
  Product read(PixelRect rect) {
    prepare(rect);
    Product out = making_.blank(rect.width(), rect.height());
    read_into(rect, making_.planes(out));
    return out;
  }
  // The same into some of the grids: planes in the order of the product's, those without values are left out.
  void read_into(PixelRect rect, const Planes& wanted) {
    visit_tiles(rect, [&](int column, int row, PixelRect part) {
      make_missing(column, row, part);
      store_.get(column, row, part, rect.x0, rect.y0, wanted);
    });
    place_.maker_holds = true;
  }
  // `still`: the part of the sheet that will yet be asked for. Forgets tiles that touch nothing of it, and makes others within it alone.
  // What is asked for outside of it all the same is made again, with its whole tile.
  void keep_only(PixelRect still) {
    still_ = intersection(sheet_, still);
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

  // `visit` gets each tile that a rectangle touches, and the part of the rectangle in it.
  template <class Visit>
  void visit_tiles(PixelRect rect, const Visit& visit) {
    for (int row = rect.y0 / tile_px_; row <= (rect.y1 - 1) / tile_px_; ++row)
      for (int column = rect.x0 / tile_px_; column <= (rect.x1 - 1) / tile_px_; ++column)
        visit(column, row, intersection(rect, store_.rect(column, row)));
  }

  void make_missing(int column, int row, PixelRect part) {
    if (store_.has(column, row, part)) return;
    const PixelRect within = part_to_make(store_.rect(column, row), part);
    if (place_.makers > 0 && place_.maker_holds) ++place_.made_around;
    const bool outer_holds = std::exchange(place_.maker_holds, false);
    ++place_.makers;
    Product tile = making_.make(within);
    --place_.makers;
    place_.maker_holds = outer_holds;
    store_.put(column, row, within, making_.planes(tile));
  }

  PixelRect part_to_make(PixelRect tile, PixelRect asked) {
    const PixelRect part = intersection(tile, still_);
    const bool inside = intersection(part, asked) == asked;
    if (!inside) ++place_.asked_beyond;
    return inside && !making_.whole_tiles ? part : tile;
  }

  TileStore::Place& place_;
  PixelRect sheet_;
  PixelRect still_;
  Making making_;
  TileStore store_;
  int tile_px_ = 0;
};

}  // namespace belvedere
