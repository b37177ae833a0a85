#include "renderer/pipeline/sheet_pieces.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "base/grid.h"
#include "base/memory_limit.h"
#include "renderer/exemplar/scan.h"
#include "renderer/image/image_io.h"
#include "renderer/world/scene_dem.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

TEST(SheetPieces, CoverTheRegionOnce) {
  for (const PixelRect region : {PixelRect{0, 0, 500, 210}, {99, 100, 101, 400}, {7, 7, 8, 8}}) {
    Grid<int> count(region.width(), region.height(), 0);
    for (const PixelRect& piece : pieces_of(region, {.piece_px = 100})) {
      EXPECT_EQ(piece.x0 / 100, (piece.x1 - 1) / 100) << "of one square of the sheet's grid";
      EXPECT_EQ(piece.y0 / 100, (piece.y1 - 1) / 100);
      for (const auto [x, y] : test::cells(piece)) ++count(x - region.x0, y - region.y0);
    }
    for (const int n : count) ASSERT_EQ(n, 1);
  }
}

TEST(SheetPieces, FollowEachOtherAlongTheShorterSide) {
  EXPECT_EQ(pieces_of({0, 0, 400, 200}, {.piece_px = 100})[1], (PixelRect{0, 100, 100, 200}));
  EXPECT_EQ(pieces_of({0, 0, 200, 400}, {.piece_px = 100})[1], (PixelRect{100, 0, 200, 100}));
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

constexpr double mib = 1048576.0;

Scene print_of(const std::vector<std::string>& settings = {}) {
  std::vector<std::string> all = {"output.width=20000", "output.height=8000",
                                  "output.sheet_width_mm=1200"};
  all.insert(all.end(), settings.begin(), settings.end());
  return test::small_scene(all).scene;
}

int block_of(const Scene& scene, std::uint64_t memory_mib, const StandingBytes& standing = {}) {
  const MemoryLimit limit(memory_mib << 20U);
  return choose_block_px(scene, scene.pixels_per_unit(), standing);
}

TEST(SheetMemory, LessMemoryMakesSmallerBlocksAndTooLittleIsRefused) {
  const Scene scene = print_of();
  EXPECT_EQ(block_of(scene, 6144), 1024);
  // Windows of (1024 + 2 · 67 units)² pixels: surroundings that are sampled in a wide view take no
  // more.
  EXPECT_EQ(block_of(scene, 1300), 1024);
  EXPECT_LT(block_of(scene, 700), 1024);
  EXPECT_GE(block_of(scene, 700), 256);
  EXPECT_NE(test::message_of(ErrorKind::limit, [&] { block_of(scene, 200); }).find("MiB"),
            std::string::npos);
}

TEST(SheetMemory, WhatStandsThereLeavesLessToBlocks) {
  const Scene scene = print_of();
  ASSERT_EQ(block_of(scene, 2048), 1024);
  EXPECT_LT(block_of(scene, 2048, {.ground = 1000.0 * mib}), 1024);
  EXPECT_LT(block_of(scene, 2048, {.besides = 1000.0 * mib}), 1024);
  // Pictures to copy from that leave nothing are refused, with what the whole takes.
  const std::string refused =
      test::message_of(ErrorKind::limit, [&] { block_of(scene, 2048, {.besides = 1700.0 * mib}); });
  EXPECT_NE(refused.find("at most 2048 MiB"), std::string::npos) << refused;
  // Ground was fitted to the memory: it is not refused for what it leaves.
  EXPECT_LT(block_of(scene, 2048, {.ground = 1700.0 * mib}), 1024);
}

TEST(SheetMemory, GroundCountsBeforeItIsMade) {
  const LoadedScene scene = test::small_scene();
  const double made = ground_bytes(make_world(scene, silent_progress()));
  const double expected = ground_bytes(held_ground_cells(scene));
  EXPECT_GE(expected, made);
  EXPECT_LE(expected, 1.5 * made);
}

TEST(SheetMemory, WhatIsPaintedAsAWholeIsRefusedSooner) {
  const Scene scene = print_of();
  const MemoryLimit limit(700U << 20U);
  EXPECT_LT(choose_block_px(scene, scene.pixels_per_unit()), 1024);
  EXPECT_FALSE(test::message_of(ErrorKind::limit, [&] {
                 choose_block_px(scene, scene.pixels_per_unit(), {}, 1024);
               }).empty());
}

TEST(SheetMemory, SmallPartsHaveSmallTiles) {
  EXPECT_EQ(choose_tile_px(1024, {0, 0, 20000, 8000}), 1024);
  EXPECT_EQ(choose_tile_px(512, {0, 0, 20000, 8000}), 512);
  EXPECT_EQ(choose_tile_px(1024, {500, 600, 2900, 1100}), 512);
  EXPECT_EQ(choose_tile_px(1024, {500, 600, 501, 601}), 256);
  EXPECT_EQ(choose_tile_px(128, {500, 600, 501, 601}), 128);
}

TEST(SheetMemory, AllThatIsCopiedFromIsCounted) {
  const auto bytes = [](const std::vector<std::string>& settings) {
    return copying_bytes(print_of(settings), 0.0);
  };
  // A texel for eight pixels of the sheet.
  const double sheet = bytes({});
  EXPECT_NEAR(sheet, 20e6 * 85.0, 0.01 * sheet);
  EXPECT_NEAR(bytes({"exemplar=[{ width = 1000, height = 500 }]"}), 0.5e6 * 85.0, 1.0);
  // A painting that is missing leaves the sheet that is painted instead.
  const std::string painting =
      "exemplar=[{ picture = \"p.png\", classes = \"c.tif\", optional = true }]";
  EXPECT_EQ(bytes({painting}), sheet);
  EXPECT_EQ(copying_bytes(print_of({painting}), 300.0 * 200.0), 300.0 * 200.0 * 85.0);
  std::vector<PaintedExemplar> exemplars(1);
  exemplars[0].picture = Grid<glm::vec3>(300, 200);
  EXPECT_EQ(copying_bytes(exemplars), 300.0 * 200.0 * 85.0);
}

// Their sizes come from the headers of the files.
TEST(SheetMemory, PaintingsCountBeforeTheyAreRead) {
  const test::Folder folder;
  write_png8(folder / "p.png", Grid<glm::vec3>(300, 200, glm::vec3(0.5F)), {});
  LoadedScene scene =
      test::small_scene({"exemplar=[{ picture = \"p.png\", classes = \"c.png\" }]"});
  EXPECT_EQ(painting_texels(scene), 0.0) << "it is missing";
  scene.allowed_folders = {folder.path()};
  EXPECT_EQ(painting_texels(scene), 300.0 * 200.0);
}

}  // namespace
}  // namespace belvedere
