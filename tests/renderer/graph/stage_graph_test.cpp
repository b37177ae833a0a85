#include "renderer/graph/stage_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "base/grid.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr glm::ivec2 sheet_px{70, 45};
constexpr PixelRect sheet{0, 0, sheet_px.x, sheet_px.y};

// Two grids of different types whose values encode their position on the sheet.
struct Product {
  Grid<std::uint32_t> position;
  Grid<std::uint8_t> column;
};
Product product_of(PixelRect rect) {
  Product product{Grid<std::uint32_t>(rect.width(), rect.height()),
                  Grid<std::uint8_t>(rect.width(), rect.height())};
  for (const auto [x, y] : test::cells(rect.width(), rect.height())) {
    product.position(x, y) = static_cast<std::uint32_t>((rect.y0 + y) * 1000 + rect.x0 + x);
    product.column(x, y) = static_cast<std::uint8_t>(rect.x0 + x);
  }
  return product;
}

using Numbers = Grid<std::uint32_t>;

// For a part of a window the sums within `reach` of each pixel; beyond the window's edge there is
// nothing.
Numbers sums_around(const Window<Numbers>& window, PixelRect part, Reach reach) {
  Numbers sums(part.width(), part.height(), 0);
  const PixelRect inside = window.inside(part);
  for (const auto [x, y] : test::cells(sums))
    for (int v = -reach.rows; v <= reach.rows; ++v)
      for (int u = -reach.columns; u <= reach.columns; ++u)
        if (window.value.contains(inside.x0 + x + u, inside.y0 + y + v))
          sums(x, y) += window.value(inside.x0 + x + u, inside.y0 + y + v);
  return sums;
}

class StageGraphTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  StageNode::Declaration tiles(const char* name, int tile_px = 16) const {
    return {.name = name, .size_px = sheet_px, .tile_px = tile_px};
  }
  // Positions, and how often each pixel was made.
  Stage<Product>* add_places(StageGraph& graph, bool whole_tiles = false) {
    StageNode::Declaration declared = tiles("places");
    declared.whole_tiles = whole_tiles;
    return graph.add_tiles<Product>(declared, grids_of(&Product::position, &Product::column),
                                    std::tuple(), [this](const Tile& tile) {
                                      made.push_back(tile.rect);
                                      return product_of(tile.rect);
                                    });
  }
  // Numbers that differ from pixel to pixel.
  Stage<Numbers>* add_numbers(StageGraph& graph, int tile_px = 16) {
    return graph.add_tiles<Numbers>(tiles("numbers", tile_px), one_grid<Numbers>(), std::tuple(),
                                    [this](const Tile& tile) {
                                      made.push_back(tile.rect);
                                      Numbers numbers = product_of(tile.rect).position;
                                      for (std::uint32_t& number : numbers)
                                        number = number * 2654435761U >> 20U;
                                      return numbers;
                                    });
  }
  // `declared`: where it differs from what the sums read.
  static Stage<Numbers>* add_sums(StageGraph& graph, Stage<Numbers>* from, Reach reach,
                                  const char* name = "sums", int tile_px = 16,
                                  std::optional<Reach> declared = {}) {
    return graph.add_tiles<Numbers>({.name = name, .size_px = sheet_px, .tile_px = tile_px},
                                    one_grid<Numbers>(),
                                    std::tuple(reads(from, declared.value_or(reach))),
                                    [reach](const Tile& tile, const Window<Numbers>& window) {
                                      return sums_around(window, tile.rect, reach);
                                    });
  }
  void expect(Stage<Product>* positions, PixelRect rect) {
    const Product got = positions->read(rect);
    const Product right = product_of(rect);
    EXPECT_TRUE(got.position == right.position);
    EXPECT_TRUE(got.column == right.column);
  }
  int pixels_made() const {
    int pixels = 0;
    for (const PixelRect& rect : made) pixels += rect.width() * rect.height();
    return pixels;
  }

  const test::Folder folder_;
  TileStore::Place scratch_{folder_.path(), GetParam()};
  StageGraph graph_{scratch_, silent_progress()};
  std::vector<PixelRect> made;
};

TEST_P(StageGraphTest, AnyRectangleIsWhatTheTilesHold) {
  Stage<Product>* positions = add_places(graph_);
  expect(positions, {69, 44, 70, 45});
  EXPECT_EQ(made.size(), 1U) << "only what is looked at is made";
  expect(positions, {15, 15, 17, 33});
  expect(positions, sheet);
  EXPECT_EQ(made.size(), 5U * 3U) << "and each tile once";
  EXPECT_EQ(folder_.count(), 0U) << "scratch files have no name";
}

TEST_P(StageGraphTest, WhatIsPreparedIsThereWhenItIsRead) {
  Stage<Product>* positions = add_places(graph_);
  positions->prepare({15, 15, 17, 33});
  EXPECT_EQ(made.size(), 6U);
  expect(positions, {15, 15, 17, 33});
  EXPECT_EQ(made.size(), 6U);
}

TEST_P(StageGraphTest, SomeGridsCanBeReadAlone) {
  Stage<Product>* positions = add_places(graph_);
  const Product columns = positions->read({3, 4, 40, 20}, with_grids(&Product::column));
  EXPECT_TRUE(columns.position.empty());
  EXPECT_TRUE(columns.column == product_of({3, 4, 40, 20}).column);
}

TEST_P(StageGraphTest, WhatWasForgottenIsMadeAgain) {
  Stage<Product>* positions = add_places(graph_);
  const std::uint64_t free = scratch_.memory_bytes;
  expect(positions, sheet);
  const StageGraph::Request one[] = {{positions, {32, 16, 33, 17}}};
  graph_.keep_only(one);
  expect(positions, {32, 16, 48, 32});
  EXPECT_EQ(made.size(), 15U);
  expect(positions, sheet);
  EXPECT_EQ(made.size(), 15U + 14U);
  graph_.keep_only({});
  EXPECT_EQ(scratch_.memory_bytes, free);
}

TEST_P(StageGraphTest, NoMoreIsMadeThanIsAskedFor) {
  Stage<Product>* positions = add_places(graph_);
  const StageGraph::Request part[] = {{positions, {10, 15, 35, 40}}};
  graph_.keep_only(part);
  expect(positions, {10, 15, 35, 40});
  EXPECT_EQ(pixels_made(), 25 * 25);
  EXPECT_EQ(made.size(), 9U);
  // A part of a tile is not made twice; what was not announced is made with its whole tile, again.
  expect(positions, {20, 20, 30, 30});
  EXPECT_EQ(made.size(), 9U);
  expect(positions, {9, 15, 11, 16});
  EXPECT_EQ(made.size(), 10U);
  EXPECT_EQ(pixels_made(), 25 * 25 + 16 * 16);
  expect(positions, sheet);
}

TEST_P(StageGraphTest, WholeTilesAreMadeWhole) {
  Stage<Product>* positions = add_places(graph_, true);
  const StageGraph::Request part[] = {{positions, {10, 15, 35, 40}}};
  graph_.keep_only(part);
  expect(positions, {33, 20, 34, 30});
  EXPECT_EQ(pixels_made(), 16 * 16);
}

// A stage of whole tiles needs the reach of its whole tiles, however little of them is requested.
TEST_P(StageGraphTest, WholeTilesNeedWhatAllOfThemReaches) {
  Stage<Numbers>* numbers = add_numbers(graph_);
  StageNode::Declaration declared = tiles("whole");
  declared.whole_tiles = true;
  Stage<Numbers>* whole = graph_.add_tiles<Numbers>(
      declared, one_grid<Numbers>(), std::tuple(reads(numbers, around(2))),
      [](const Tile& tile, const Window<Numbers>& window) {
        return sums_around(window, tile.rect, around(2));
      });
  const StageGraph::Request part[] = {{whole, {20, 20, 21, 21}}};
  graph_.keep_only(part);
  whole->read({20, 20, 21, 21});
  EXPECT_EQ(whole->made_px(), 16U * 16U);
  EXPECT_EQ(pixels_made(), 20 * 20);
}

// A sum of sums reads as far as both together, rows farther than columns; at the sheet's edge there
// is less to sum.
TEST_P(StageGraphTest, StagesReadWhatTheyDeclareWhateverTheTiles) {
  const auto picture = [&](int tile_px, PixelRect rect) {
    TileStore::Place scratch{folder_.path(), GetParam()};
    StageGraph graph(scratch, silent_progress());
    Stage<Numbers>* sums = add_sums(graph, add_numbers(graph, tile_px), {2, 5}, "sums", tile_px);
    Stage<Numbers>* twice = add_sums(graph, sums, around(3), "twice", tile_px);
    const StageGraph::Request request[] = {{twice, rect}};
    graph.keep_only(request);
    return twice->read(rect);
  };
  const Numbers whole = picture(128, sheet);
  for (const int tile_px : {8, 16, 64})
    for (const PixelRect rect :
         {PixelRect{0, 0, 1, 1}, PixelRect{20, 11, 50, 33}, PixelRect{60, 40, 70, 45}})
      EXPECT_TRUE(picture(tile_px, rect) == part_of(whole, rect)) << tile_px << " " << rect.x0;
}

TEST_P(StageGraphTest, ARectangleNeedsExactlyWhatItsStagesReach) {
  Stage<Numbers>* sums = add_sums(graph_, add_numbers(graph_), {2, 5});
  Stage<Numbers>* twice = add_sums(graph_, sums, around(3), "twice");
  const PixelRect rect{30, 20, 34, 24};
  const StageGraph::Request request[] = {{twice, rect}};
  graph_.keep_only(request);
  twice->read(rect);
  EXPECT_EQ(sums->made_px(), 10U * 10U);
  EXPECT_EQ(pixels_made(), (10 + 2 * 2) * (10 + 2 * 5)) << "nothing outside it, and nothing twice";
}

TEST_P(StageGraphTest, HalfTheReachGivesOtherPixels) {
  const auto read = [&](int rows) {
    TileStore::Place scratch{folder_.path(), GetParam()};
    StageGraph graph(scratch, silent_progress());
    return add_sums(graph, add_numbers(graph), {0, 4}, "sums", 16, Reach{0, rows})->read(sheet);
  };
  EXPECT_TRUE(read(4) == read(9));
  EXPECT_FALSE(read(4) == read(2));
}

// All inputs exist before memory is taken for the first of them.
TEST_P(StageGraphTest, NoWindowIsHeldWhileAnotherStageIsMade) {
  int held = 0;
  int made_around = 0;
  const auto counted = [&](const char* name) {
    return graph_.add_tiles<Numbers>(
        tiles(name),
        {.blank =
             [&](int width, int height) {
               held += width * height > 1 ? 1 : 0;
               return Numbers(width, height);
             },
         .planes = [](Numbers& numbers) { return Planes{plane_of(numbers)}; }},
        std::tuple(), [&](const Tile& tile) {
          made_around += held;
          return Numbers(tile.rect.width(), tile.rect.height());
        });
  };
  Stage<Numbers>* first = counted("first");
  Stage<Numbers>* second = counted("second");
  Stage<Numbers>* both = graph_.add_tiles<Numbers>(
      tiles("both"), one_grid<Numbers>(),
      std::tuple(reads(first, around(20)), reads(second, around(20))),
      [&](const Tile& tile, const Window<Numbers>&, const Window<Numbers>&) {
        held -= 2;
        return Numbers(tile.rect.width(), tile.rect.height());
      });
  both->read({20, 20, 40, 30});
  EXPECT_EQ(held, 0);
  EXPECT_EQ(made_around, 0);
}

// Pixels of a coarser stage contain several of the sheet's.
TEST_P(StageGraphTest, CoarserStagesAreReadInTheirOwnPixels) {
  Stage<Numbers>* coarse = graph_.add_tiles<Numbers>(
      {.name = "coarse", .size_px = {18, 12}, .scale = 4, .tile_px = 8}, one_grid<Numbers>(),
      std::tuple(), [](const Tile& tile) { return product_of(tile.rect).position; });
  Stage<Numbers>* fine = graph_.add_tiles<Numbers>(
      tiles("fine"), one_grid<Numbers>(), std::tuple(reads(coarse, around(6))),
      [](const Tile& tile, const Window<Numbers>& window) {
        EXPECT_EQ(window.scale, 4);
        Numbers nearest(tile.rect.width(), tile.rect.height());
        for (const auto [x, y] : test::cells(nearest))
          nearest(x, y) = window.value((tile.rect.x0 + x) / 4 - window.rect.x0,
                                       (tile.rect.y0 + y) / 4 - window.rect.y0);
        return nearest;
      });
  const Numbers numbers = fine->read(sheet);
  EXPECT_EQ(numbers(0, 0), 0U);
  EXPECT_EQ(numbers(69, 44), 11017U);
  EXPECT_EQ(numbers(33, 21), 5008U);
}

// Where a condition holds a stage reads farther; it is evaluated on another stage around each tile.
TEST_P(StageGraphTest, AConditionWidensTheReachOfTilesThatNeedIt) {
  Stage<Numbers>* numbers = add_numbers(graph_);
  std::map<int, int> rows_read;  // of tiles by their first row
  StageNode::Declaration declared = tiles("conditional");
  declared.condition = seen_in<Numbers>(
      numbers, around(1), Wanted<Numbers>([](int w, int h) { return Numbers(w, h); }),
      [](const Numbers& seen) { return std::find(seen.begin(), seen.end(), 0U) != seen.end(); });
  Stage<Numbers>* conditional = graph_.add_tiles<Numbers>(
      declared, one_grid<Numbers>(),
      std::tuple(Reads<Numbers>{.stage = numbers, .reach = {}, .wide_reach = rows_around(20)}),
      [&](const Tile& tile, const Window<Numbers>& window) {
        if (tile.rect.x0 == 0) rows_read[tile.rect.y0] = window.rect.height() - tile.rect.height();
        EXPECT_EQ(tile.wide, window.rect.height() > tile.rect.height());
        return part_of(window.value, window.inside(tile.rect));
      });
  EXPECT_TRUE(conditional->read(sheet) == numbers->read(sheet));
  EXPECT_EQ(rows_read[0], 20) << "number 0 is in the corner";
  EXPECT_EQ(rows_read[32], 0);
  const StageGraph::Request request[] = {{conditional, {0, 34, 16, 45}}};
  graph_.keep_only(request);
  made.clear();
  numbers->read({0, 14, 16, 45});
  EXPECT_TRUE(made.empty()) << "what the wider reach may need is kept";
}

TEST_P(StageGraphTest, ViewsAreMadeForEachReaderAndKeptNowhere) {
  Stage<Numbers>* numbers = add_numbers(graph_);
  int filled = 0;
  Stage<Numbers>* view = graph_.add_view<Numbers>(
      {.name = "doubled", .size_px = sheet_px}, one_grid<Numbers>(),
      std::tuple(reads_in_pieces(numbers)),
      [&](const Tile& tile, Numbers& out, const WindowReader<Numbers>& from) {
        ++filled;
        from.read_into(tile.rect, out);
        for (std::uint32_t& number : out) number *= 2;
      });
  Stage<Numbers>* sums = add_sums(graph_, view, around(1));
  EXPECT_EQ(view->read({3, 3, 4, 4})(0, 0), 2 * numbers->read({3, 3, 4, 4})(0, 0));
  EXPECT_EQ(sums->read({3, 3, 4, 4}).size(), 1U);
  EXPECT_EQ(filled, 2);
}

TEST_P(StageGraphTest, NothingIsReadBeyondWhatWasDeclared) {
  Stage<Numbers>* numbers = add_numbers(graph_);
  Stage<Numbers>* view = graph_.add_view<Numbers>(
      {.name = "greedy", .size_px = sheet_px}, one_grid<Numbers>(),
      std::tuple(reads_in_pieces(numbers)),
      [&](const Tile& tile, Numbers& out, const WindowReader<Numbers>& from) {
        from.read_into(grown(tile.rect, 1), out);
      });
  const std::string said = test::message_of(ErrorKind::bug, [&] { view->read({3, 3, 4, 4}); });
  EXPECT_NE(said.find("than was declared: columns 3 to 4"), std::string::npos) << said;
}

// Memory of a stage: the windows of its inputs, working memory for the largest of them, and its
// result.
TEST_P(StageGraphTest, MemoryIsCountedFromTheDeclarations) {
  Stage<Product>* positions = add_places(graph_);
  StageNode::Declaration declared = tiles("reader");
  declared.work_bytes_per_pixel = 3.0;
  Stage<Numbers>* reader = graph_.add_tiles<Numbers>(
      declared, one_grid<Numbers>(),
      std::tuple(reads(positions, around(5), with_grids(&Product::column))),
      [](const Tile& tile, const Window<Product>&) {
        return Numbers(tile.rect.width(), tile.rect.height());
      });
  EXPECT_EQ(reader->bytes_to_make(20), 30.0 * 30.0 * (1.0 + 3.0) + 20.0 * 20.0 * 4.0);
  EXPECT_EQ(graph_.bytes_to_make(*reader, 20), reader->bytes_to_make(20));
  EXPECT_EQ(reader->bytes_to_make(1000), 70.0 * 45.0 * 8.0) << "there is no more than the sheet";
}

TEST_P(StageGraphTest, AWishToStopIsHeardBetweenTiles) {
  struct StopAfter final : Progress {
    int tiles = 3;
    void advance(double) override {
      if (--tiles == 0) throw Error(ErrorKind::interrupted, "test", "stopped");
    }
  } progress;
  StageGraph graph(scratch_, progress);
  Stage<Product>* positions = add_places(graph);
  test::message_of(ErrorKind::interrupted, [&] { positions->read(sheet); });
  EXPECT_EQ(made.size(), 3U);
}

TEST_P(StageGraphTest, ItsDrawingSaysWhatReadsWhat) {
  Stage<Numbers>* numbers = add_numbers(graph_);
  add_sums(graph_, add_sums(graph_, numbers, rows_around(4)), around(3), "sums of sums");
  EXPECT_EQ(graph_.draw(2.0),
            "flowchart TD\n  numbers[numbers]\n  sums[sums]\n  numbers -->|2 up and down| sums\n"
            "  sums_of_sums[sums of sums]\n  sums -->|2| sums_of_sums\n");
}

// Nothing, two tiles, everything fits into memory.
INSTANTIATE_TEST_SUITE_P(Memory, StageGraphTest, testing::Values(0U, 2U * 5U * 256U, 1U << 20U));

}  // namespace
}  // namespace belvedere
