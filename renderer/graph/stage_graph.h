#pragma once

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

#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/graph/stage_product.h"
#include "renderer/graph/tile_store.h"

namespace belvedere {

// A graph of declared stages. Each stage says once what it reads and how far around its own pixels; the executor derives the rest: which
// pixels of which stage a rectangle needs, in what order they are made, how long tiles stay in memory, and what all of it takes.
//
// Tiles are made once, where somebody asks, and kept until no remaining request needs them. A *view* only rearranges other stages: it is
// made for each reader and kept nowhere. A stage's function gets its inputs as values and never asks a store for anything.

// How far a reader looks around its own pixels, px of its own.
struct Reach {
  int columns = 0;  // left and right
  int rows = 0;     // up and down
  bool operator==(const Reach&) const = default;
};
constexpr Reach around(int px) { return {px, px}; }
constexpr Reach rows_around(int px) { return {0, px}; }

// What a stage is asked for.
struct Tile {
  PixelRect rect;     // of its own pixels
  bool wide = false;  // whether its condition holds, so that it reads within its wide reach
};

// The smallest rectangle around two; an empty one counts for nothing.
PixelRect bounding_rect(const PixelRect& a, const PixelRect& b);

// A stage, whatever it makes: its declaration, and what the executor derives from it.
class StageNode {
 public:
  struct Source {
    StageNode* stage = nullptr;  // null: the scene has none, and nothing is read
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
    int scale = 1;                      // pixels of the sheet to one of these, along x and y
    int tile_px = 0;                    // side of its tiles; 0: a view
    bool whole_tiles = false;           // equal only where its own tiles are made whole
    double work_bytes_per_pixel = 0.0;  // that its function takes for each pixel of its largest input besides inputs and result
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

  // Makes the tiles that a rectangle lacks. All inputs of a tile are prepared before memory is taken for the first of them: otherwise the
  // windows of every stage behind would stand in memory around that of the first.
  virtual void prepare(PixelRect rect) = 0;
  // The part of the sheet that will still be asked for: tiles beside it are forgotten, and no pixel beside it is made.
  virtual void keep_only(PixelRect wanted) = 0;
  // A rectangle's window in a source, cut by its sheet.
  PixelRect window(const Source& source, const Tile& tile) const;
  // The most memory that a square of `side` pixels takes while it is made, its inputs being prepared, bytes.
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

// What is read of a product where not all of it is: a blank one, whose empty grids are left out.
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
  // The same into the grids that `out` has, of what is prepared.
  virtual void read_into(PixelRect rect, Product& out) = 0;
  virtual const ProductFormat<Product>& format() const = 0;
  double bytes_per_pixel() const override { return format().bytes_per_pixel(); }
};

// An input as its reader gets it: a window of another stage.
template <class Product>
struct Window {
  Product value;   // empty where there is nothing to read
  PixelRect rect;  // of the source's pixels
  int scale = 1;   // pixels of the sheet to one of these
  glm::ivec2 origin_px() const { return {rect.x0, rect.y0}; }
  // A rectangle of the source's sheet as one of the window.
  PixelRect inside(PixelRect of_sheet) const { return moved(of_sheet, -rect.x0, -rect.y0); }
};

// An input that its reader takes piece by piece, so that not all of it stands in memory at once.
void check_inside(PixelRect window, PixelRect rect);  // Error(bug) where it is not
template <class Product>
class WindowReader {
 public:
  WindowReader(Stage<Product>* stage, PixelRect rect) : stage_(stage), rect_(rect) {}
  // Fills the grids that `out` has. Error(bug) beyond the declared window.
  void read_into(PixelRect rect, Product& out) const {
    check_inside(rect_, rect);
    stage_->read_into(rect, out);
  }
  PixelRect rect() const { return rect_; }

 private:
  Stage<Product>* stage_;
  PixelRect rect_;
};

// What a stage reads: of which stage, how far around, and which grids of it (none named: all).
template <class Product>
struct Reads {
  Stage<Product>* stage = nullptr;
  Reach reach = {};
  Wanted<Product> wanted = {};
  std::optional<Reach> wide_reach = {};

  StageNode::Source source() const {
    if (stage == nullptr) return {};
    const ProductFormat<Product> format{wanted ? wanted : stage->format().blank, stage->format().planes};
    return {stage, reach, wide_reach.value_or(reach), format.bytes_per_pixel()};
  }
  Window<Product> take(PixelRect rect) const {
    if (stage == nullptr) return {};
    Window<Product> window{(wanted ? wanted : stage->format().blank)(rect.width(), rect.height()), rect, stage->declaration().scale};
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
// A condition: whether `test` is true of a window of another stage.
template <class Product, class Test>
StageNode::Condition seen_in(Stage<Product>* stage, Reach reach, Wanted<Product> wanted, Test test) {
  return {stage, reach,
          [stage, wanted = std::move(wanted), test = std::move(test)](PixelRect window) { return test(stage->read(window, wanted)); }};
}

class StageGraph {
 public:
  // `place`: where tiles are kept. Both must outlive the graph. `progress` is asked between tiles whether to stop.
  explicit StageGraph(TileStore::Place& place, Progress& progress) : place_(place), progress_(progress) {}

  // A stage whose tiles are kept: make(tile, window of each input …) returns a tile.
  template <class Product, class... Inputs, class Make>
  Stage<Product>* add_tiles(StageNode::Declaration declaration, ProductFormat<Product> format, std::tuple<Inputs...> inputs, Make make);
  // A view: fill(tile, out, window of each input …) fills the grids that `out` has.
  template <class Product, class... Inputs, class Fill>
  Stage<Product>* add_view(StageNode::Declaration declaration, ProductFormat<Product> format, std::tuple<Inputs...> inputs, Fill fill);

  // What will still be asked for, of all stages; everything else is forgotten, and only what these need is made. To ask for more costs time
  // alone. Until it is called everything may be asked for.
  struct Request {
    StageNode* stage;
    PixelRect rect;
  };
  void keep_only(std::span<const Request> requests);

  // In the order in which they were added: each after those that it reads.
  const std::vector<std::unique_ptr<StageNode>>& stages() const { return stages_; }
  // The most memory that `output`, or the tiles of any stage, take for a square of the sheet of `side` pixels, bytes.
  double bytes_to_make(const StageNode& output, int side) const;
  // The stages as a drawing in the language of Mermaid: boxes are kept in tiles, round ones are views, and arrows say how far around a
  // pixel the reader looks, in units of .5 mm.
  std::string draw(double pixels_per_unit) const;

 private:
  template <class Product, class Derived>
  Stage<Product>* adopt(std::unique_ptr<Derived> stage) {
    Derived* added = stage.get();
    stages_.push_back(std::move(stage));
    return added;
  }
  TileStore::Place& place_;
  Progress& progress_;
  std::vector<std::unique_ptr<StageNode>> stages_;
};

namespace stages {

template <class... Inputs>
std::vector<StageNode::Source> sources_of(const std::tuple<Inputs...>& inputs) {
  return std::apply([](const auto&... input) { return std::vector<StageNode::Source>{input.source()...}; }, inputs);
}

// Takes the inputs of a tile, one after the other, and calls `use` with them.
template <class... Inputs, class Use>
auto with_inputs(const StageNode& stage, const Tile& tile, const std::tuple<Inputs...>& inputs, const Use& use) {
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
  Tiles(StageNode::Declaration declaration, ProductFormat<Product> format, Inputs inputs, Make make, TileStore::Place& place,
        Progress& progress)
      : Stage<Product>(std::move(declaration), sources_of(inputs)),
        format_(std::move(format)),
        inputs_(std::move(inputs)),
        make_(std::move(make)),
        progress_(progress),
        wanted_(this->sheet()),
        store_(place, this->sheet().x1, this->sheet().y1, this->declaration().tile_px, value_bytes(format_)) {}

  void prepare(PixelRect rect) override {
    visit(rect, [&](int column, int row, PixelRect part) {
      if (!store_.has(column, row, part)) make(column, row, part);
    });
  }
  void read_into(PixelRect rect, Product& out) override {
    const Planes planes = format_.planes(out);
    visit(rect, [&](int column, int row, PixelRect part) { store_.get(column, row, part, rect.x0, rect.y0, planes); });
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

  // Each tile that a rectangle touches, and the part of the rectangle in it.
  template <class Visit>
  void visit(PixelRect rect, const Visit& visit_tile) const {
    const int side = this->declaration().tile_px;
    for (int row = rect.y0 / side; row <= (rect.y1 - 1) / side; ++row)
      for (int column = rect.x0 / side; column <= (rect.x1 - 1) / side; ++column)
        visit_tile(column, row, intersection(rect, store_.rect(column, row)));
  }

  // Of a tile at the border of what is wanted only the part inside; what is asked for beyond it is made again, with its whole tile.
  PixelRect part_to_make(PixelRect tile, PixelRect asked) const {
    const PixelRect part = intersection(tile, wanted_);
    return intersection(part, asked) == asked && !this->declaration().whole_tiles ? part : tile;
  }

  void make(int column, int row, PixelRect asked) {
    const Tile tile = this->tile_of(part_to_make(store_.rect(column, row), asked));
    this->prepare_sources(tile);
    Product made = with_inputs(*this, tile, inputs_, [&](const auto&... windows) { return make_(tile, windows...); });
    store_.put(column, row, tile.rect, format_.planes(made));
    this->made_px_ += static_cast<std::uint64_t>(tile.rect.width()) * static_cast<std::uint64_t>(tile.rect.height());
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
    with_inputs(*this, tile, inputs_, [&](const auto&... windows) { fill_(tile, out, windows...); });
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
Stage<Product>* StageGraph::add_tiles(StageNode::Declaration declaration, ProductFormat<Product> format, std::tuple<Inputs...> inputs,
                                      Make make) {
  return adopt<Product>(std::make_unique<stages::Tiles<Product, std::tuple<Inputs...>, Make>>(
      std::move(declaration), std::move(format), std::move(inputs), std::move(make), place_, progress_));
}

template <class Product, class... Inputs, class Fill>
Stage<Product>* StageGraph::add_view(StageNode::Declaration declaration, ProductFormat<Product> format, std::tuple<Inputs...> inputs,
                                     Fill fill) {
  return adopt<Product>(std::make_unique<stages::View<Product, std::tuple<Inputs...>, Fill>>(std::move(declaration), std::move(format),
                                                                                             std::move(inputs), std::move(fill)));
}

}  // namespace belvedere
