#include "terrain/layers/layer_drawing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/grid.h"
#include "tests/terrain/layers/metres.h"

namespace belvedere {
namespace {

using test::metres;
using enum LandCoverClass;

std::vector<Grid<float>> no_shares(int width, int height) {
  return std::vector<Grid<float>>(static_cast<std::size_t>(land_cover_class_count),
                                  Grid<float>(width, height));
}
Grid<float>& of(std::vector<Grid<float>>& shares, LandCoverClass id) {
  return shares[static_cast<std::size_t>(id)];
}

double frequency(const Grid<LandCoverClass>& classes, LandCoverClass id) {
  return static_cast<double>(std::count(classes.begin(), classes.end(), id)) /
         static_cast<double>(classes.size());
}

std::vector<Grid<float>> constant_shares(int size) {
  std::vector<Grid<float>> shares = no_shares(size, size);
  of(shares, forest) = Grid<float>(size, size, 0.55F);
  of(shares, rock) = Grid<float>(size, size, 0.3F);
  of(shares, snow) = Grid<float>(size, size, 0.12F);
  of(shares, water) = Grid<float>(size, size, 0.03F);
  return shares;
}

// Without sharpening the frequency is the share, for any spectrum of the noise.
TEST(LayerDrawing, FrequencyIsTheShare) {
  for (const double spectrum : {0.0, 0.5, 2.0}) {
    LayerDrawingParameters parameters;
    parameters.power = 1.0;
    parameters.spectrum = spectrum;
    parameters.octaves = 4;
    const std::vector<Grid<float>> shares = constant_shares(700);
    const Grid<LandCoverClass> drawn =
        draw_classes(plan_layer_drawing(parameters, shares), shares, metres, {0, 0, 700, 700});
    EXPECT_NEAR(frequency(drawn, forest), 0.55, 0.015) << spectrum;
    EXPECT_NEAR(frequency(drawn, rock), 0.30, 0.015) << spectrum;
    EXPECT_NEAR(frequency(drawn, snow), 0.12, 0.01) << spectrum;
    EXPECT_NEAR(frequency(drawn, water), 0.03, 0.006) << spectrum;
  }
}

// From forest to rock over the region, with a little snow on rock: sharpened shares have the same
// total frequency, but are less mixed.
TEST(LayerDrawing, SharpeningKeepsMeanShares) {
  constexpr int size = 600;
  std::vector<Grid<float>> shares = no_shares(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float t = static_cast<float>(x) / size;
      of(shares, forest)(x, y) = 1.F - t;
      of(shares, rock)(x, y) = 0.8F * t;
      of(shares, snow)(x, y) = 0.2F * t;
    }
  const auto drawn_by = [&](double power) {
    LayerDrawingParameters parameters;
    parameters.power = power;
    return draw_classes(plan_layer_drawing(parameters, shares), shares, metres, {0, 0, size, size});
  };
  const auto mixing = [&](const Grid<LandCoverClass>& drawn) {
    int edges = 0;
    for (int y = 0; y < size; ++y)
      for (int x = 1; x < size; ++x) edges += drawn(x, y) != drawn(x - 1, y) ? 1 : 0;
    return edges;
  };
  const Grid<LandCoverClass> as_shares_say = drawn_by(1.0);
  for (const double power : {2.0, 3.0}) {
    const Grid<LandCoverClass> drawn = drawn_by(power);
    EXPECT_NEAR(frequency(drawn, forest), 0.5, 0.02) << power;
    EXPECT_NEAR(frequency(drawn, rock), 0.4, 0.02) << power;
    EXPECT_NEAR(frequency(drawn, snow), 0.1, 0.02) << power;
    EXPECT_LT(mixing(drawn), 0.8 * mixing(as_shares_say)) << power;
  }
}

TEST(LayerDrawing, LargeSpectraMakeLargePatches) {
  const std::vector<Grid<float>> shares = constant_shares(400);
  const auto edges = [&](double spectrum) {
    LayerDrawingParameters parameters;
    parameters.spectrum = spectrum;
    const Grid<LandCoverClass> drawn =
        draw_classes(plan_layer_drawing(parameters, shares), shares, metres, {0, 0, 400, 400});
    int count = 0;
    for (int y = 0; y < 400; ++y)
      for (int x = 1; x < 400; ++x) count += drawn(x, y) != drawn(x - 1, y) ? 1 : 0;
    return count / (400.0 * 399.0);
  };
  EXPECT_GT(edges(0.0), 2.0 * edges(2.0));
}

TEST(LayerDrawing, AnyRectangleHasTheBitsOfTheWhole) {
  const std::vector<Grid<float>> shares = constant_shares(150);
  const PixelRect part{31, 17, 120, 133};
  std::vector<Grid<float>> cut;
  for (const Grid<float>& grid : shares) cut.push_back(part_of(grid, part));
  const LayerDrawing drawing = plan_layer_drawing({}, shares);
  const Grid<LandCoverClass> whole = draw_classes(drawing, shares, metres, {0, 0, 150, 150});
  EXPECT_EQ(part_of(whole, part), draw_classes(drawing, cut, metres, part));
}

TEST(LayerDrawing, NothingIsDrawnWhereNothingIs) {
  std::vector<Grid<float>> shares = no_shares(4, 1);
  of(shares, sky)(0, 0) = 1.F;
  of(shares, rock)(1, 0) = 1e-6F;
  const Grid<LandCoverClass> drawn =
      draw_classes(plan_layer_drawing({}, shares), shares, metres, {0, 0, 4, 1});
  EXPECT_EQ(drawn(0, 0), sky);
  EXPECT_EQ(drawn(1, 0), rock);
  EXPECT_THROW(plan_layer_drawing({.power = 0.5}, shares), Error);
}

}  // namespace
}  // namespace belvedere
