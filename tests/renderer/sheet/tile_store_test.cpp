#include "renderer/sheet/tile_store.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <utility>

#include "renderer/sheet/sheet_stage.h"
#include "tests/files.h"

namespace belvedere {
namespace {

// Two planes of different types whose values say their place on the sheet.
struct Product {
  Grid<std::uint32_t> place;
  Grid<std::uint8_t> column;
};
Product product_of(PixelRect rect) {
  Product product{Grid<std::uint32_t>(rect.width(), rect.height()), Grid<std::uint8_t>(rect.width(), rect.height())};
  for (int y = 0; y < rect.height(); ++y)
    for (int x = 0; x < rect.width(); ++x) {
      product.place(x, y) = static_cast<std::uint32_t>((rect.y0 + y) * 1000 + rect.x0 + x);
      product.column(x, y) = static_cast<std::uint8_t>(rect.x0 + x);
    }
  return product;
}

class Stage {
 public:
  Stage(const std::string& folder, std::uint64_t memory, bool whole_tiles = false)
      : place_{folder, memory},
        stage_(place_, 70, 45, 16,
               {.make =
                    [this](PixelRect tile) {
                      EXPECT_EQ(asked, 0) << "memory was taken before";
                      ++made;
                      pixels += tile.width() * tile.height();
                      return product_of(tile);
                    },
                .blank =
                    [this](int w, int h) {
                      ++asked;
                      return Product{Grid<std::uint32_t>(w, h), Grid<std::uint8_t>(w, h)};
                    },
                .planes =
                    [](Product& p) {
                      return Planes{plane_of(p.place), plane_of(p.column)};
                    },
                .whole_tiles = whole_tiles}) {
    asked = 0;
  }
  void expect(PixelRect rect) {
    asked = 0;
    const Product got = stage_.read(rect);
    const Product right = product_of(rect);
    EXPECT_TRUE(got.place == right.place);
    EXPECT_TRUE(got.column == right.column);
  }
  int asked = 0;  // products without values, since a rectangle was asked for
  int made = 0;
  int pixels = 0;  // that were made
  TileStore::Place place_;
  SheetStage<Product> stage_;
};

class SheetStageMemory : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SheetStageMemory, AnyRectangleIsWhatTheTilesHold) {
  const test::Folder folder;
  Stage stage(folder.path(), GetParam());
  stage.expect({69, 44, 70, 45});
  EXPECT_EQ(stage.made, 1) << "only what is looked at is made";
  stage.expect({15, 15, 17, 33});
  stage.expect({0, 0, 70, 45});
  EXPECT_EQ(stage.made, 5 * 3) << "and each tile once";
  EXPECT_EQ(folder.count(), 0U) << "scratch files have no name";
}

TEST_P(SheetStageMemory, WhatIsPreparedIsThereWhenItIsRead) {
  const test::Folder folder;
  Stage stage(folder.path(), GetParam());
  stage.stage_.prepare({15, 15, 17, 33});
  EXPECT_EQ(stage.made, 6);
  stage.expect({15, 15, 17, 33});
  EXPECT_EQ(stage.made, 6);
}

TEST_P(SheetStageMemory, WhatWasDroppedIsMadeAgain) {
  const test::Folder folder;
  Stage stage(folder.path(), GetParam());
  const std::uint64_t free = stage.place_.memory_bytes;
  stage.expect({0, 0, 70, 45});
  stage.stage_.keep_only({32, 16, 33, 17});
  stage.expect({32, 16, 48, 32});
  EXPECT_EQ(stage.made, 15);
  stage.expect({0, 0, 70, 45});
  EXPECT_EQ(stage.made, 15 + 14);
  stage.stage_.keep_only({});
  EXPECT_EQ(stage.place_.memory_bytes, free);
}

TEST_P(SheetStageMemory, NoMoreIsMadeThanWillBeAskedFor) {
  const test::Folder folder;
  Stage stage(folder.path(), GetParam());
  stage.stage_.keep_only({10, 15, 35, 40});
  stage.expect({10, 15, 35, 40});
  EXPECT_EQ(stage.pixels, 25 * 25);
  EXPECT_EQ(stage.made, 9);
  // A part of a tile is not made twice, and what was not said to be asked for is the whole tile, made again.
  stage.expect({20, 20, 30, 30});
  EXPECT_EQ(stage.made, 9);
  stage.expect({9, 15, 11, 16});
  EXPECT_EQ(stage.made, 10);
  EXPECT_EQ(stage.pixels, 25 * 25 + 16 * 16);
  EXPECT_EQ(stage.place_.asked_beyond, 1);
  stage.expect({0, 0, 70, 45});
  stage.stage_.keep_only({});
  stage.expect({0, 0, 70, 45});
}

TEST_P(SheetStageMemory, ProductsOfWholeTilesAreMadeWhole) {
  const test::Folder folder;
  Stage stage(folder.path(), GetParam(), true);
  stage.stage_.keep_only({10, 15, 35, 40});
  stage.expect({33, 20, 34, 30});
  EXPECT_EQ(stage.made, 1);
  EXPECT_EQ(stage.pixels, 16 * 16);
}

// A maker that reads two other products: the second is made around the windows of the first unless it was prepared before.
TEST(SheetStage, CountsTilesThatAreMadeAroundWindows) {
  const test::Folder folder;
  const auto made_around = [&](bool with_first, bool second_prepared) {
    TileStore::Place place{folder.path(), 1U << 20U};
    const auto making = [](std::function<Product(PixelRect)> make) {
      return SheetStage<Product>::Making{.make = std::move(make),
                                         .blank =
                                             [](int w, int h) {
                                               return Product{Grid<std::uint32_t>(w, h), Grid<std::uint8_t>(w, h)};
                                             },
                                         .planes =
                                             [](Product& p) {
                                               return Planes{plane_of(p.place), plane_of(p.column)};
                                             }};
    };
    SheetStage<Product> first(place, 70, 45, 16, making(product_of));
    SheetStage<Product> second(place, 70, 45, 16, making(product_of));
    SheetStage<Product> both(place, 70, 45, 16, making([&](PixelRect tile) {
                               if (second_prepared) second.prepare(tile);
                               if (with_first) first.read(tile);
                               return second.read(tile);
                             }));
    both.read({0, 0, 33, 16});
    return place.made_around;
  };
  EXPECT_EQ(made_around(true, false), 3);
  EXPECT_EQ(made_around(true, true), 0);
  EXPECT_EQ(made_around(false, false), 0) << "nothing is held when the only one is made";
}

// Nothing, two tiles, everything.
INSTANTIATE_TEST_SUITE_P(TileStore, SheetStageMemory, testing::Values(0U, 2U * 5U * 256U, 1U << 20U));

TEST(TileStore, AFolderThatCannotBeWrittenIsAnErrorOfTheOutput) {
  const std::string message = test::message_of(ErrorKind::output, [] {
    Stage stage("/proc/nowhere", 0);
    stage.stage_.read({0, 0, 1, 1});
  });
  EXPECT_NE(message.find("scratch"), std::string::npos) << message;
}

TEST(TileStore, PlanesAndPlacesThatAreNotTheTilesAreRefused) {
  const test::Folder folder;
  TileStore::Place place{folder.path(), 1000};
  TileStore store(place, 10, 10, 8, {1});
  Grid<std::uint8_t> wrong(7, 8);
  test::message_of(ErrorKind::bug, [&] { store.put(0, 0, {0, 0, 8, 8}, {plane_of(wrong)}); });
  test::message_of(ErrorKind::bug, [&] { store.put(0, 0, {1, 0, 9, 8}, {plane_of(wrong)}); });
}

}  // namespace
}  // namespace belvedere
