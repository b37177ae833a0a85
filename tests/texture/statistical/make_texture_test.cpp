#include "texture/statistical/make_texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <set>
#include <string>
#include <vector>

#include "base/cache/content_hash.h"
#include "base/error.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/files.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/statistical/learn_texture.h"

namespace belvedere {
namespace {

const CliqueModel& meadow_model() {
  static const CliqueModel model = [] {
    LearnParameters few;
    few.types = 24;
    return learn_texture(test::meadow_crop(96, 96), {}, few).model;
  }();
  return model;
}

// Of one level and few types: windows are made of whole tiles, and a fast model is as good a test.
const CliqueModel& window_model() {
  static const CliqueModel model = [] {
    return learn_texture(test::meadow_crop(80, 80), {},
                         {.types = 16, .levels = 1, .reach_px = 5, .coarse_reach = 3})
        .model;
  }();
  return model;
}

TEST(MakeTexture, TheSameBitsForAnyThreads) {
  std::vector<Grid<Rgb8>> made;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    made.push_back(make_texture(meadow_model(), 150, 90, {.sweeps = 6}));
  }
  EXPECT_EQ(made[0], made[1]);
  EXPECT_EQ(made[0], made[2]);
}

TEST(MakeTexture, AnotherSeedIsAnotherTexture) {
  const Grid<Rgb8> one = make_texture(meadow_model(), 64, 64, {.seed = 1, .sweeps = 4});
  const Grid<Rgb8> other = make_texture(meadow_model(), 64, 64, {.seed = 2, .sweeps = 4});
  EXPECT_EQ(one.width(), 64);
  EXPECT_NE(one, other);
}

// Windows of an unbounded texture: two of them show the same at one position, across tiles and left
// of and above its origin.
TEST(MakeWindow, OverlappingWindowsHaveTheSamePixels) {
  const TextureParameters parameters{.rounds = 1, .sweeps = 1};
  const TextureRecord record = record_texture(window_model(), parameters);
  const PixelRect whole{-40, endless_tile_px - 60, 60, endless_tile_px + 50};
  const Grid<Rgb8> all = make_window(window_model(), record, whole, parameters);
  for (const PixelRect rect : {PixelRect{-5, endless_tile_px + 3, 20, endless_tile_px + 9},
                               PixelRect{0, endless_tile_px, 1, endless_tile_px + 1},
                               PixelRect{-40, endless_tile_px - 60, -1, endless_tile_px + 2}})
    EXPECT_EQ(make_window(window_model(), record, rect, parameters),
              part_of(all, moved(rect, -whole.x0, -whole.y0)));
}

// However far it is made: no piece of 4 × 4 pixels occurs twice where four tiles meet, and tiles a
// thousand tiles away have another beginning.
TEST(MakeWindow, NeverRepeats) {
  const TextureParameters parameters{.rounds = 1, .sweeps = 1};
  const TextureRecord record = record_texture(window_model(), parameters);
  constexpr int tile = endless_tile_px;
  std::vector<Grid<Rgb8>> windows;
  for (const glm::ivec2 at : {glm::ivec2(tile - 60, tile - 60), glm::ivec2(1000 * tile, 0)})
    windows.push_back(
        make_window(window_model(), record, {at.x, at.y, at.x + 120, at.y + 120}, parameters));
  std::set<std::string> pieces;
  std::size_t count = 0;
  for (const Grid<Rgb8>& window : windows)
    for (int y = 0; y + 4 <= window.height(); ++y)
      for (int x = 0; x + 4 <= window.width(); ++x) {
        std::string piece;
        for (int j = 0; j < 4; ++j)
          piece.append(reinterpret_cast<const char*>(window.row(y + j) + x), 4 * sizeof(Rgb8));
        pieces.insert(std::move(piece));
        ++count;
      }
  EXPECT_EQ(pieces.size(), count);
}

// Every piece of 6 × 6 pixels of 64 tiles, at all positions.
TEST(MakeWindowLong, NothingRepeatsOver4096Squared) {
  const TextureParameters parameters{.rounds = 6, .sweeps = 2};
  const TextureRecord record = record_texture(meadow_model(), parameters);
  constexpr int side = 4096;
  constexpr int piece = 6;
  const Grid<Rgb8> all =
      make_window(meadow_model(), record, {-side / 2, 0, side / 2, side}, parameters);
  std::vector<std::uint64_t> pieces(static_cast<std::size_t>(side - piece + 1) *
                                    static_cast<std::size_t>(side - piece + 1));
  parallel_rows(side - piece + 1, [&](int y) {
    for (int x = 0; x + piece <= side; ++x) {
      std::uint64_t hash = 0;
      for (int j = 0; j < piece; ++j)
        for (int i = 0; i < piece; ++i) {
          const Rgb8& c = all(x + i, y + j);
          hash = mix_bits(hash ^ (std::uint64_t{c[0]} | std::uint64_t{c[1]} << 8 |
                                  std::uint64_t{c[2]} << 16 | std::uint64_t{1} << 40));
        }
      pieces[static_cast<std::size_t>(y) * static_cast<std::size_t>(side - piece + 1) +
             static_cast<std::size_t>(x)] = hash;
    }
  });
  std::sort(pieces.begin(), pieces.end());
  EXPECT_EQ(std::adjacent_find(pieces.begin(), pieces.end()), pieces.end());
}

// Two tiles in windows of two shapes and orders, on different threads, put together: one hash. The
// same over 8192² is in docs/textures.md.
TEST(MakeWindow, AnyOrderOfWindowsHasOneHash) {
  const TextureParameters parameters{.rounds = 1, .sweeps = 1};
  const TextureRecord record = record_texture(window_model(), parameters);
  constexpr int across = endless_tile_px + 40;
  constexpr int down = 90;
  const auto hash = [&](int first_x, int first_y, int width, int height, bool backwards,
                        int threads) {
    const ThreadLimit limit(threads);
    std::vector<PixelRect> windows;
    for (int y = first_y; y < down; y += height)
      for (int x = first_x; x < across; x += width)
        windows.push_back({std::max(0, x), std::max(0, y), std::min(across, x + width),
                           std::min(down, y + height)});
    if (backwards) std::reverse(windows.begin(), windows.end());
    Grid<Rgb8> all(across, down);
    for (const PixelRect& window : windows) {
      const Grid<Rgb8> made = make_window(window_model(), record, window, parameters);
      for (int y = 0; y < window.height(); ++y)
        std::copy_n(made.row(y), window.width(), all.row(window.y0 + y) + window.x0);
    }
    ContentHash of;
    of.add(all.data(), all.size() * sizeof(Rgb8));
    return of.digits();
  };
  EXPECT_EQ(hash(0, 0, endless_tile_px, down, false, 1), hash(-300, 0, 700, down, true, 3));
}

// Tiles meet without a seam: steps across their border are as large as elsewhere.
TEST(MakeWindow, TilesMeetWithoutASeam) {
  const TextureParameters parameters{.rounds = 12, .sweeps = 2};
  const TextureRecord record = record_texture(window_model(), parameters);
  const Grid<Rgb8> made =
      make_window(window_model(), record,
                  {endless_tile_px - 60, 0, endless_tile_px + 60, endless_tile_px}, parameters);
  const auto step = [&](int x) {
    double sum = 0.0;
    for (int y = 0; y < made.height(); ++y)
      for (std::size_t c = 0; c < 3; ++c) sum += std::abs(made(x, y)[c] - made(x - 1, y)[c]);
    return sum / made.height();
  };
  double inside = 0.0;
  for (int x = 20; x < 100; ++x)
    if (x != 60) inside += step(x) / 79.0;
  EXPECT_LT(step(60) / inside, 1.15);
  EXPECT_GT(step(60) / inside, .85);
}

// A hole in the crop itself: nothing else changes, and its border shows no larger step than its
// surroundings.
TEST(FillTexture, ChangesTheHoleAloneAndLeavesNoSeam) {
  const Grid<Rgb8> crop = test::meadow_crop(200, 160);
  Grid<Rgb8> picture = crop;
  Grid<std::uint8_t> hole(200, 160, 0);
  for (int y = 50; y < 110; ++y)
    for (int x = 70; x < 140; ++x) {
      hole(x, y) = 1;
      picture(x, y) = {255, 0, 0};
    }
  const Grid<Rgb8> filled = fill_texture(picture, hole, meadow_model(), {});
  const auto step = [&](int x, int y) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) sum += std::abs(filled(x, y)[c] - filled(x - 1, y)[c]);
    return sum;
  };
  double seam = 0.0;
  double inside = 0.0;
  int red = 0;
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 200; ++x) {
      if (hole(x, y) == 0) {
        EXPECT_EQ(filled(x, y), crop(x, y));
      } else {
        red += filled(x, y)[0] > 220 && filled(x, y)[1] < 40 ? 1 : 0;
      }
    }
  for (int y = 50; y < 110; ++y) {
    seam += (step(70, y) + step(140, y)) / 120.0;
    for (int x = 10; x < 60; ++x) inside += step(x, y) / (60.0 * 50.0);
  }
  double made = 0.0;
  for (int y = 55; y < 105; ++y)
    for (int x = 76; x < 134; ++x) made += step(x, y) / (50.0 * 58.0);
  EXPECT_EQ(red, 0);
  EXPECT_LT(seam / (.5 * (inside + made)), 1.3) << seam << " " << inside << " " << made;
  EXPECT_GT(seam / (.5 * (inside + made)), .6);
  EXPECT_EQ(fill_texture(picture, Grid<std::uint8_t>(200, 160, 0), meadow_model(), {}), picture);
}

TEST(MakeTexture, SizesOverTheLimitAreRefused) {
  EXPECT_THROW(make_texture(meadow_model(), 1 << 20, 1 << 20, {}), Error);
  EXPECT_THROW(make_texture(meadow_model(), 0, 10, {}), Error);
}

// The extent of a hole is limited, the size of the scan around it is not.
TEST(FillTexture, HolesOverTheLimitAreRefused) {
  const int width = static_cast<int>(max_texture_pixels / 64) + 400;
  const Grid<Rgb8> scan(width, 64, Rgb8{90, 130, 60});
  Grid<std::uint8_t> hole(width, 64);
  hole(9, 9) = 1;
  EXPECT_EQ(fill_texture(scan, hole, meadow_model(), {.rounds = 1, .sweeps = 1}).width(), width);
  hole(width - 1, 9) = 1;
  EXPECT_EQ(test::error_of([&] { fill_texture(scan, hole, meadow_model(), {}); }).kind(),
            ErrorKind::limit);
}

}  // namespace
}  // namespace belvedere
