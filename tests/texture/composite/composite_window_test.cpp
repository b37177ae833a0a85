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

const TextureParameters quick_window{.rounds = 6, .sweeps = 2};

const CompositeRecord& record() {
  static const CompositeRecord r = record_composite(two_textures_model(), quick_window);
  return r;
}

// Discs on a ground, over four tiles.
Grid<std::uint8_t> drawn() {
  Grid<std::uint8_t> labels(560, 530);
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const int u = x % 160 - 80;
      const int v = y % 140 - 70;
      labels(x, y) = u * u + v * v < 2500 ? 1 : 0;
    }
  return labels;
}

TEST(CompositeWindow, AnyWindowIsAPartOfTheWhole) {
  const Grid<std::uint8_t> labels = drawn();
  const Grid<Rgb8> whole = make_composite_window(two_textures_model(), record(), labels, {0, 0, 560, 530}, quick_window);
  const ThreadLimit threads(3);
  for (const PixelRect window : {PixelRect{480, 490, 560, 530}, PixelRect{500, 0, 530, 40}})
    EXPECT_EQ(make_composite_window(two_textures_model(), record(), labels, window, quick_window), part_of(whole, window));
  // Each label in its texture.
  const Grid<std::uint8_t> zone = near_borders(labels, 6);
  int wrong = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) wrong += zone[i] == 0 && is_green(whole[i]) != (labels[i] == 0) ? 1 : 0;
  EXPECT_LT(wrong, static_cast<int>(whole.size() / 500));
  // No step where tiles meet: that of one column is as that of those beside it.
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
  EXPECT_THROW(make_composite_window(two_textures_model(), record(), drawn(), {500, 0, 600, 40}, quick_window), Error);
}

}  // namespace
}  // namespace belvedere
