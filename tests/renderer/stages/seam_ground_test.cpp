#include "renderer/stages/seam_ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/grid.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/grids.h"
#include "tests/texture/statistical/texture_crops.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr int side = 160;

glm::vec3 colour(const Rgb8& c) { return glm::vec3(c[0], c[1], c[2]) / 255.F; }

// Two paintings of one class each: green meadow and the same in brown.
std::vector<PaintedExemplar> paintings() {
  std::vector<PaintedExemplar> out(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const Grid<Rgb8> meadow = test::meadow_crop(140, 120, 20 + i);
    out[i].picture = Grid<glm::vec3>(140, 120);
    out[i].base = Grid<glm::vec3>(140, 120, glm::vec3(.4F));
    out[i].exemplar.guides.label = Grid<std::uint8_t>(140, 120, static_cast<std::uint8_t>(pasture));
    for (std::size_t k = 0; k < meadow.size(); ++k) {
      const glm::vec3 c = colour(meadow[k]);
      out[i].picture[k] = i == 0 ? c : glm::vec3(c.y, .6F * c.y, c.z);
    }
  }
  return out;
}

// Paint of the two, side by side along a bent line, in even light.
PaintBeforeSeams paint() {
  static const std::vector<PaintedExemplar> two = paintings();
  PaintBeforeSeams out{Grid<glm::vec3>(side, 120), Grid<std::uint16_t>(side, 120),
                       Grid<float>(side, 120, 1000.F)};
  for (const auto [x, y] : test::cells(side, 120)) {
    const std::size_t source =
        x < 70 + static_cast<int>(6.0 * gaussian_noise(5, 0.0, y, 9.0)) ? 0 : 1;
    out.source(x, y) = source_of(source, pasture);
    out.even(x, y) = in_even_light(two[source].picture(x % 140, y), nullptr, 0.0, pasture);
  }
  return out;
}

const SeamSources& sources() {
  static const SeamSources out = find_seam_sources(paintings(), 0.0, 3);
  return out;
}

double step_across(const Grid<glm::vec3>& even, const Grid<std::uint16_t>& source) {
  double sum = 0.0;
  int count = 0;
  for (const auto [x, y] : test::cells({1, 0, even.width(), even.height()}))
    if (source(x, y) != source(x - 1, y)) {
      for (int c = 0; c < 3; ++c)
        sum += static_cast<double>(std::abs(even(x, y)[c] - even(x - 1, y)[c]));
      ++count;
    }
  return sum / count;
}

TEST(KnitGround, SourcesAreTheFullestSquaresOfAClass) {
  ASSERT_EQ(sources().of.size(), 2U);
  EXPECT_EQ(sources().of[0][static_cast<std::size_t>(pasture)].picture.width(), seam_sample_px);
  EXPECT_EQ(sources().of[0][static_cast<std::size_t>(pasture)].picture.height(), 120);
  EXPECT_TRUE(sources().of[1][static_cast<std::size_t>(rock)].picture.empty());
}

TEST(KnitGround, PixelsAlongTheSeamAloneAndLessOfAStep) {
  SeamModels models(&sources());
  PaintBeforeSeams given = paint();
  const PixelRect all{0, 0, side, 120};
  const SeamPaint with_seam = synthesize_ground_seams(models, given, all, all, 3);
  Grid<glm::vec3> even = given.even;
  int made = 0;
  for (const auto [x, y] : test::cells(side, 120)) {
    bool near = false;
    for (int v = y - seam_half_px; v <= y + seam_half_px; ++v)
      for (int u = x - seam_half_px; u <= x + seam_half_px; ++u)
        near |= given.source.clamped(u, v) != given.source(x, y);
    if (with_seam.made(x, y) == 0) continue;
    ASSERT_TRUE(near) << x << " " << y;
    even(x, y) = with_seam.even(x, y);
    ++made;
  }
  EXPECT_GT(made, 120 * 2 * (seam_half_px - 1));
  EXPECT_LT(step_across(even, given.source), .6 * step_across(given.even, given.source));
}

TEST(KnitGround, WhatHidesAnotherHasNoSeam) {
  SeamModels models(&sources());
  PaintBeforeSeams given = paint();
  for (std::size_t i = 0; i < given.source.size(); ++i)
    if (given.source[i] != source_of(0, pasture)) given.depth_m[i] = 2000.F;
  const SeamPaint with_seam =
      synthesize_ground_seams(models, given, {0, 0, side, 120}, {0, 0, side, 120}, 3);
  for (const std::uint8_t made : with_seam.made) ASSERT_EQ(made, 0);
  // Nor does paint of one painting, whatever its classes.
  PaintBeforeSeams one = paint();
  for (std::uint16_t& source : one.source)
    source = source == source_of(0, pasture) ? source_of(1, rock) : source;
  const SeamPaint none =
      synthesize_ground_seams(models, one, {0, 0, side, 120}, {0, 0, side, 120}, 3);
  for (const std::uint8_t made : none.made) ASSERT_EQ(made, 0);
}

// The order in which models are learnt, and threads, change nothing.
TEST(KnitGround, ATileIsTheSameWhoeverAsksFirst) {
  const PaintBeforeSeams given = paint();
  const PixelRect tile{32, 32, 96, 96};
  const PixelRect window = grown(tile, seam_margin_px);
  const PaintBeforeSeams around{part_of(given.even, {0, 0, 128, 120}),
                                part_of(given.source, {0, 0, 128, 120}),
                                part_of(given.depth_m, {0, 0, 128, 120})};
  const PixelRect cut{window.x0, window.y0, window.x1, 120};
  SeamModels fresh(&sources());
  const SeamPaint one = synthesize_ground_seams(fresh, around, tile, cut, 3);
  SeamModels used(&sources());
  synthesize_ground_seams(used, given, {0, 0, side, 120}, {0, 0, side, 120}, 3);
  const ThreadLimit threads(3);
  const SeamPaint other = synthesize_ground_seams(used, around, tile, cut, 3);
  EXPECT_EQ(one.made, other.made);
  EXPECT_EQ(one.even, other.even);
}

}  // namespace
}  // namespace belvedere
