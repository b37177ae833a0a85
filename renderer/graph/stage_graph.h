#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/graph/tile_store.h"

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

// A graph of declared stages. Each stage declares what it reads and how far around its own pixels;
// the executor derives the rest: which pixels of which stage a rectangle needs, the order in which
// they are made, how long tiles stay in memory, and the memory needed.
// Tiles are made once, on request, and kept until no remaining request needs them. A *view* only
// rearranges other stages: it is made for each reader and not kept. A stage's function gets its
// inputs as values and does not access a store.

// How far a reader reads around its own pixels, in its own px.
struct Reach {
  int columns = 0;  // left and right
  int rows = 0;     // up and down
  bool operator==(const Reach&) const = default;
};
constexpr Reach around(int px) { return {px, px}; }
constexpr Reach rows_around(int px) { return {0, px}; }

// A request to a stage.
struct Tile {
  PixelRect rect;     // of its own pixels
  bool wide = false;  // whether its condition holds, so that it reads within its wide reach
};

// The smallest rectangle around two; an empty one is ignored.
PixelRect bounding_rect(const PixelRect& a, const PixelRect& b);

// A stage of any product: its declaration, and what the executor derives from it.
class StageNode {
 public:
  struct Source {
    StageNode* stage = nullptr;  // null: not in this scene, nothing is read
    Reach reach;
    Reach wide_reach;              // where the condition holds; never smaller
    double bytes_per_pixel = 0.0;  // of the grids that are read
  };
  // Whether a tile needs the wide reach, found from a cheaper stage around it.
  struct Condition {
    StageNode* stage = nullptr;
    Reach reach;
    std::function<bool(PixelRect window)> holds;
  };
  struct Declaration {
    std::string name;
    glm::ivec2 size_px{0};
    int scale = 1;             // pixels of the sheet to one of these, along x and y
    int tile_px = 0;           // side of its tiles; 0: a view
    bool whole_tiles = false;  // the result is reproducible only if its own tiles are made whole
    double work_bytes_per_pixel = 0.0;  // memory of its function for each pixel of its largest
                                        // input, in addition to inputs and result
    std::optional<Condition> condition = {};
  };

  StageNode(Declaration declaration, std::vector<Source> sources);
  virtual ~StageNode() = default;
  StageNode(const StageNode&) = delete;
  StageNode& operator=(const StageNode&) = delete;

  const Declaration& declaration() const { return declaration_; }
  const std::vector<Source>& sources() const { return sources_; }
  PixelRect sheet() const { return {0, 0, declaration_.size_px.x, declaration_.size_px.y}; }
  std::uint64_t made_px() const { return made_px_; }

  // Makes the missing tiles of a rectangle. All inputs of a tile are prepared before memory for the
  // first is taken: otherwise the windows of all earlier stages would be in memory at the same
  // time.
  virtual void prepare(PixelRect rect) = 0;
  // The part of the sheet that will still be requested: tiles outside it are dropped, and no pixel
  // outside it is made.
  virtual void keep_only(PixelRect wanted) = 0;
  // A rectangle's window in a source, clipped to its sheet.
  PixelRect window(const Source& source, const Tile& tile) const;
  // The max memory to make a square of `side` pixels, with its inputs prepared, bytes.
  double bytes_to_make(int side) const;
  virtual double bytes_per_pixel() const = 0;

 protected:
  Tile tile_of(PixelRect rect) const;
  void prepare_sources(const Tile& tile) const;
  std::uint64_t made_px_ = 0;

 private:
  friend class StageGraph;
  PixelRect demand(const Source& source, PixelRect wanted) const;
  Declaration declaration_;
  std::vector<Source> sources_;
  PixelRect wanted_;
};

// Reads only part of a product: a blank one, whose empty grids are skipped.
template <class Product>
using Wanted = std::function<Product(int width, int height)>;

template <class Product>
class Stage : public StageNode {
 public:
  using StageNode::StageNode;
  // A rectangle of the sheet, or some grids of it.
  Product read(PixelRect rect) { return read(rect, format().blank); }
  Product read(PixelRect rect, const Wanted<Product>& wanted) {
    prepare(rect);
    Product out = wanted(rect.width(), rect.height());
    read_into(rect, out);
    return out;
  }
  // The same into the grids present in `out`, from prepared tiles.
  virtual void read_into(PixelRect rect, Product& out) = 0;
  virtual const ProductFormat<Product>& format() const = 0;
  double bytes_per_pixel() const override { return format().bytes_per_pixel(); }
};

// An input as passed to its reader: a window of another stage.
template <class Product>
struct Window {
  Product value;   // empty if there is nothing to read
  PixelRect rect;  // of the source's pixels
  int scale = 1;   // pixels of the sheet to one of these
  glm::ivec2 origin_px() const { return {rect.x0, rect.y0}; }
  // A rectangle of the source's sheet as one of the window.
  PixelRect inside(PixelRect of_sheet) const { return moved(of_sheet, -rect.x0, -rect.y0); }
};

// An input that its reader takes piece by piece, so that it is never in memory as a whole.
void check_inside(PixelRect window, PixelRect rect);  // Error(bug) otherwise
template <class Product>
class WindowReader {
 public:
  WindowReader(Stage<Product>* stage, PixelRect rect) : stage_(stage), rect_(rect) {}
  // Fills the grids present in `out`. Error(bug) beyond the declared window.
  void read_into(PixelRect rect, Product& out) const {
    check_inside(rect_, rect);
    stage_->read_into(rect, out);
  }
  PixelRect rect() const { return rect_; }

 private:
  Stage<Product>* stage_;
  PixelRect rect_;
};

// An input of a stage: which stage, how far around, and which of its grids (none named: all).
template <class Product>
struct Reads {
  Stage<Product>* stage = nullptr;
  Reach reach = {};
  Wanted<Product> wanted = {};
  std::optional<Reach> wide_reach = {};

  StageNode::Source source() const {
    if (stage == nullptr) return {};
    const ProductFormat<Product> format{wanted ? wanted : stage->format().blank,
                                        stage->format().planes};
    return {stage, reach, wide_reach.value_or(reach), format.bytes_per_pixel()};
  }
  Window<Product> take(PixelRect rect) const {
    if (stage == nullptr) return {};
    Window<Product> window{(wanted ? wanted : stage->format().blank)(rect.width(), rect.height()),
                           rect, stage->declaration().scale};
    stage->read_into(rect, window.value);
    return window;
  }
};
// The same, taken piece by piece.
template <class Product>
struct ReadsInPieces {
  Stage<Product>* stage = nullptr;
  Reach reach = {};

  StageNode::Source source() const { return {stage, reach, reach, 0.0}; }
  WindowReader<Product> take(PixelRect rect) const { return {stage, rect}; }
};

template <class Product>
Reads<Product> reads(Stage<Product>* stage, Reach reach = {}, Wanted<Product> wanted = {}) {
  return {stage, reach, std::move(wanted)};
}
template <class Product>
ReadsInPieces<Product> reads_in_pieces(Stage<Product>* stage, Reach reach = {}) {
  return {stage, reach};
}
// A condition: whether `test` is true for a window of another stage.
template <class Product, class Test>
StageNode::Condition seen_in(Stage<Product>* stage, Reach reach, Wanted<Product> wanted,
                             Test test) {
  return {stage, reach,
          [stage, wanted = std::move(wanted), test = std::move(test)](PixelRect window) {
            return test(stage->read(window, wanted));
          }};
}

class StageGraph {
 public:
  // `scratch`: where tiles are kept. Both must outlive the graph. `progress` is polled between
  // tiles for interruption.
  explicit StageGraph(TileStore::Place& scratch, Progress& progress)
      : scratch_(scratch), progress_(progress) {}

  // A stage whose tiles are kept: make(tile, window of each input …) returns a tile.
  template <class Product, class... Inputs, class Make>
  Stage<Product>* add_tiles(StageNode::Declaration declaration, ProductFormat<Product> format,
                            std::tuple<Inputs...> inputs, Make make);
  // A view: fill(tile, out, window of each input …) fills the grids present in `out`.
  template <class Product, class... Inputs, class Fill>
  Stage<Product>* add_view(StageNode::Declaration declaration, ProductFormat<Product> format,
                           std::tuple<Inputs...> inputs, Fill fill);

  // Declares all further requests, for all stages; tiles that they do not need are dropped and no
  // longer made. Requesting more only costs time. Until this is called anything may be requested.
  struct Request {
    StageNode* stage;
    PixelRect rect;
  };
  void keep_only(std::span<const Request> requests);

  // The stages in the order in which they were added: each after those that it reads.
  const std::vector<std::unique_ptr<StageNode>>& stages() const { return stages_; }
  // The max memory for `output`, or for the tiles of any stage, for a square of the sheet of `side`
  // pixels, bytes.
  double bytes_to_make(const StageNode& output, int side) const;
  // The stages as a Mermaid diagram: boxes are kept in tiles, round ones are views, and arrows show
  // how far around a pixel the reader reads, in units of 0.5 mm.
  std::string draw(double pixels_per_unit) const;

 private:
  template <class Product, class Derived>
  Stage<Product>* adopt(std::unique_ptr<Derived> stage) {
    Derived* added = stage.get();
    stages_.push_back(std::move(stage));
    return added;
  }
  TileStore::Place& scratch_;
  Progress& progress_;
  std::vector<std::unique_ptr<StageNode>> stages_;
};

namespace stages {

template <class... Inputs>
std::vector<StageNode::Source> sources_of(const std::tuple<Inputs...>& inputs) {
  return std::apply(
      [](const auto&... input) { return std::vector<StageNode::Source>{input.source()...}; },
      inputs);
}

// Takes the inputs of a tile, one after the other, and calls `use` with them.
template <class... Inputs, class Use>
auto with_inputs(const StageNode& stage, const Tile& tile, const std::tuple<Inputs...>& inputs,
                 const Use& use) {
  std::size_t next = 0;
  const auto take = [&](const auto& input) {
    const StageNode::Source& source = stage.sources()[next++];
    return input.take(source.stage == nullptr ? PixelRect{} : stage.window(source, tile));
  };
  return std::apply(
      [&](const auto&... input) {
        const std::tuple<decltype(take(input))...> windows{take(input)...};  // from left to right
        return std::apply(use, windows);
      },
      inputs);
}

template <class Product, class Inputs, class Make>
class Tiles final : public Stage<Product> {
 public:
  Tiles(StageNode::Declaration declaration, ProductFormat<Product> format, Inputs inputs, Make make,
        TileStore::Place& scratch, Progress& progress)
      : Stage<Product>(std::move(declaration), sources_of(inputs)),
        format_(std::move(format)),
        inputs_(std::move(inputs)),
        make_(std::move(make)),
        progress_(progress),
        wanted_(this->sheet()),
        store_(scratch, this->sheet().x1, this->sheet().y1, this->declaration().tile_px,
               value_bytes(format_)) {}

  void prepare(PixelRect rect) override {
    visit(rect, [&](int column, int row, PixelRect part) {
      if (!store_.has(column, row, part)) make(column, row, part);
    });
  }
  void read_into(PixelRect rect, Product& out) override {
    const Planes planes = format_.planes(out);
    visit(rect, [&](int column, int row, PixelRect part) {
      store_.get(column, row, part, rect.x0, rect.y0, planes);
    });
  }
  void keep_only(PixelRect wanted) override {
    wanted_ = intersection(this->sheet(), wanted);
    for (int row = 0; row < store_.down(); ++row)
      for (int column = 0; column < store_.across(); ++column)
        if (intersection(wanted_, store_.rect(column, row)).empty()) store_.drop(column, row);
  }
  const ProductFormat<Product>& format() const override { return format_; }

 private:
  static std::vector<std::size_t> value_bytes(const ProductFormat<Product>& format) {
    Product sample = format.blank(1, 1);
    std::vector<std::size_t> bytes;
    for (const Plane& plane : format.planes(sample)) bytes.push_back(plane.value_bytes);
    return bytes;
  }

  // Visits each tile that a rectangle touches, with the part of the rectangle in it.
  template <class Visit>
  void visit(PixelRect rect, const Visit& visit_tile) const {
    const int side = this->declaration().tile_px;
    for (int row = rect.y0 / side; row <= (rect.y1 - 1) / side; ++row)
      for (int column = rect.x0 / side; column <= (rect.x1 - 1) / side; ++column)
        visit_tile(column, row, intersection(rect, store_.rect(column, row)));
  }

  // Only the part of a tile inside the wanted part is made; requests beyond it make the whole tile
  // again.
  PixelRect part_to_make(PixelRect tile, PixelRect asked) const {
    const PixelRect part = intersection(tile, wanted_);
    return intersection(part, asked) == asked && !this->declaration().whole_tiles ? part : tile;
  }

  void make(int column, int row, PixelRect asked) {
    const Tile tile = this->tile_of(part_to_make(store_.rect(column, row), asked));
    this->prepare_sources(tile);
    Product made = with_inputs(*this, tile, inputs_,
                               [&](const auto&... windows) { return make_(tile, windows...); });
    store_.put(column, row, tile.rect, format_.planes(made));
    this->made_px_ += static_cast<std::uint64_t>(tile.rect.width()) *
                      static_cast<std::uint64_t>(tile.rect.height());
    progress_.advance(0.0);
  }

  ProductFormat<Product> format_;
  Inputs inputs_;
  Make make_;
  Progress& progress_;
  PixelRect wanted_;
  TileStore store_;
};

template <class Product, class Inputs, class Fill>
class View final : public Stage<Product> {
 public:
  View(StageNode::Declaration declaration, ProductFormat<Product> format, Inputs inputs, Fill fill)
      : Stage<Product>(std::move(declaration), sources_of(inputs)),
        format_(std::move(format)),
        inputs_(std::move(inputs)),
        fill_(std::move(fill)) {}

  void prepare(PixelRect rect) override { this->prepare_sources(this->tile_of(rect)); }
  void read_into(PixelRect rect, Product& out) override {
    const Tile tile = this->tile_of(rect);
    with_inputs(*this, tile, inputs_,
                [&](const auto&... windows) { fill_(tile, out, windows...); });
  }
  void keep_only(PixelRect) override {}
  const ProductFormat<Product>& format() const override { return format_; }

 private:
  ProductFormat<Product> format_;
  Inputs inputs_;
  Fill fill_;
};

}  // namespace stages

template <class Product, class... Inputs, class Make>
Stage<Product>* StageGraph::add_tiles(StageNode::Declaration declaration,
                                      ProductFormat<Product> format, std::tuple<Inputs...> inputs,
                                      Make make) {
  return adopt<Product>(std::make_unique<stages::Tiles<Product, std::tuple<Inputs...>, Make>>(
      std::move(declaration), std::move(format), std::move(inputs), std::move(make), scratch_,
      progress_));
}

template <class Product, class... Inputs, class Fill>
Stage<Product>* StageGraph::add_view(StageNode::Declaration declaration,
                                     ProductFormat<Product> format, std::tuple<Inputs...> inputs,
                                     Fill fill) {
  return adopt<Product>(std::make_unique<stages::View<Product, std::tuple<Inputs...>, Fill>>(
      std::move(declaration), std::move(format), std::move(inputs), std::move(fill)));
}

}  // namespace belvedere
