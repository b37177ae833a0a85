#include "texture/composite/composite_window.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/grid_part.h"
#include "base/parallel.h"
#include "tests/texture/composite/composite_crops.h"

namespace belvedere {
namespace {

using test::is_green;
using test::two_textures_model;

const TextureParameters quick_window{.rounds = 3, .sweeps = 1};

const CompositeRecord& record() {
  static const CompositeRecord r = record_composite(two_textures_model(), quick_window);
  return r;
}

// Discs on a ground.
Grid<std::uint8_t> discs(int width, int height) {
  Grid<std::uint8_t> labels(width, height);
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const int u = x % 160 - 80;
      const int v = y % 140 - 70;
      labels(x, y) = u * u + v * v < 2500 ? 1 : 0;
    }
  return labels;
}

TEST(CompositeWindow, AnyWindowIsAPartOfTheWhole) {
  const Grid<std::uint8_t> labels = discs(560, 140);  // two tiles
  const Grid<Rgb8> whole =
      make_composite_window(two_textures_model(), record(), labels, {0, 0, 560, 140}, quick_window);
  {
    const ThreadLimit threads(3);
    for (const PixelRect window : {PixelRect{480, 90, 560, 140}, PixelRect{530, 0, 560, 40}})
      EXPECT_EQ(make_composite_window(two_textures_model(), record(), labels, window, quick_window),
                part_of(whole, window));
    // One tile above the other.
    const Grid<std::uint8_t> tall = discs(60, 540);
    const Grid<Rgb8> column =
        make_composite_window(two_textures_model(), record(), tall, {0, 0, 60, 540}, quick_window);
    const PixelRect below{10, 515, 50, 540};
    EXPECT_EQ(make_composite_window(two_textures_model(), record(), tall, below, quick_window),
              part_of(column, below));
  }
  // Each label in its texture.
  const Grid<std::uint8_t> zone = near_borders(labels, 6);
  int wrong = 0;
  for (std::size_t i = 0; i < whole.size(); ++i)
    wrong += zone[i] == 0 && is_green(whole[i]) != (labels[i] == 0) ? 1 : 0;
  EXPECT_LT(wrong, static_cast<int>(whole.size() / 500));
  // No step where tiles meet: that column's step is like its neighbours'.
  const auto step = [&](int x) {
    double sum = 0.0;
    for (int y = 0; y < 140; ++y)
      for (std::size_t c = 0; c < 3; ++c) sum += std::abs(whole(x, y)[c] - whole(x - 1, y)[c]);
    return sum;
  };
  double around = 0.0;
  for (const int x : {504, 506, 508, 510, 514, 516, 518, 520}) around += step(x) / 8.0;
  EXPECT_LT(step(512), 1.25 * around);
}

TEST(CompositeWindow, RefusesWhatIsBeyondTheMap) {
  EXPECT_THROW(make_composite_window(two_textures_model(), record(), discs(560, 60),
                                     {500, 0, 600, 40}, quick_window),
               Error);
}

}  // namespace
}  // namespace belvedere
