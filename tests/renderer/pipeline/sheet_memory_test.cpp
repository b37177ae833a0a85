#include "renderer/pipeline/sheet_memory.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "base/memory_limit.h"
#include "renderer/exemplar/scan.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

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
