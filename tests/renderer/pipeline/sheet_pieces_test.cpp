#include "renderer/pipeline/sheet_pieces.h"

#include <gtest/gtest.h>

#include "base/grid.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

TEST(SheetPieces, CoverTheRegionOnce) {
  for (const PixelRect region : {PixelRect{0, 0, 500, 210}, {99, 100, 101, 400}, {7, 7, 8, 8}}) {
    Grid<int> count(region.width(), region.height(), 0);
    for (const PixelRect& piece : pieces_of(region, {.piece_px = 100})) {
      EXPECT_EQ(piece.x0 / 100, (piece.x1 - 1) / 100) << "of one square of the sheet's grid";
      EXPECT_EQ(piece.y0 / 100, (piece.y1 - 1) / 100);
      for (int y = piece.y0; y < piece.y1; ++y)
        for (int x = piece.x0; x < piece.x1; ++x) ++count(x - region.x0, y - region.y0);
    }
    for (const int n : count) ASSERT_EQ(n, 1);
  }
}

TEST(SheetPieces, FollowEachOtherAlongTheShorterSide) {
  const std::vector<PixelRect> wide = pieces_of({0, 0, 400, 200}, {.piece_px = 100});
  EXPECT_EQ(wide[1], (PixelRect{0, 100, 100, 200}));
  const std::vector<PixelRect> high = pieces_of({0, 0, 200, 400}, {.piece_px = 100});
  EXPECT_EQ(high[1], (PixelRect{100, 0, 200, 100}));
}

TEST(SheetPieces, PartsOfAPlanShareThemInOrder) {
  for (const std::size_t count : {1U, 7U, 160U})
    for (const int parts : {1, 3, 8}) {
      std::size_t next = 0;
      for (int part = 1; part <= parts; ++part) {
        const PieceSpan span = pieces_of_part(count, part, parts);
        EXPECT_EQ(span.first, next);
        EXPECT_LE(span.end - span.first, count / static_cast<std::size_t>(parts) + 1);
        next = span.end;
      }
      EXPECT_EQ(next, count);
    }
}

TEST(SheetPieces, LayersTakeMemoryOfAPieceAtATime) {
  const Scene scene = test::small_scene({"output.width=3000", "output.height=500"}).scene;
  EXPECT_EQ(piece_bytes_of(scene, {}), 0.0);
  const double whole = piece_bytes_of(scene, {.layers = {"ora"}});
  EXPECT_EQ(whole, piece_bytes_of(scene, {.layers = {"ora", "psd"}}));
  EXPECT_GT(whole, 1024.0 * 500.0 * 150.0);
  EXPECT_LT(whole, 1024.0 * 500.0 * 250.0);
  EXPECT_EQ(piece_bytes_of(scene, {.layers = {"ora"}, .part = PixelRect{0, 0, 512, 250}}),
            whole / 4.0);
}

TEST(SheetPieces, TheIdentityHangsOnSceneAndPart) {
  const LoadedScene scene = test::small_scene();
  EXPECT_EQ(identify(scene, {}), identify(scene, {.resume = true}));
  EXPECT_NE(identify(scene, {}), identify(scene, {.part = PixelRect{0, 0, 4, 4}}));
  EXPECT_NE(identify(scene, {}), identify(test::small_scene({"seed=4"}), {}));
  EXPECT_NE(identify(scene, {}), identify(scene, {.panorama = false}));
}

}  // namespace
}  // namespace belvedere
