#include "renderer/paint/picture_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/math_exact.h"
#include "base/random.h"
#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

constexpr float sky_depth_m = std::numeric_limits<float>::infinity();

TEST(PictureFilter, GaussianHasItsDeviationAndPlace) {
  for (const double sigma : {2.0, 9.0, 40.0}) {
    const int size = 2 * blur_reach_px(sigma) + 41;
    Grid<float> spot(size, size, 0.0F);
    spot(size / 2, size / 2) = 1.0F;
    const Grid<float> blurred = blur_in_picture(spot, sigma, {7, 3});
    double sum = 0.0, moment = 0.0, square = 0.0;
    for (const auto [x, y] : test::cells(size, size)) {
      sum += blurred(x, y);
      moment += blurred(x, y) * (x - size / 2);
      square += blurred(x, y) * (x - size / 2) * (x - size / 2);
    }
    EXPECT_NEAR(sum, 1.0, 1e-3);
    EXPECT_NEAR(moment, 0.0, 0.1 * sigma);
    EXPECT_NEAR(std::sqrt(square), sigma, 0.04 * sigma) << sigma;
  }
}

TEST(PictureFilter, BlurOnASurfaceKeepsSurfacesApart) {
  Grid<float> values(40, 20, 0.0F);
  Grid<float> depth(40, 20, 10000.0F);
  for (const auto [x, y] : test::cells({20, 0, 40, 20})) {
    values(x, y) = 1.0F;
    depth(x, y) = 20000.0F;
  }
  EXPECT_EQ(blur_on_surface(values, depth, 3.0)(19, 10), 0.0F);
  EXPECT_EQ(blur_on_surface(values, depth, 3.0)(20, 10), 1.0F);
  EXPECT_NEAR(blur_in_picture(values, 3.0, {0, 0})(19, 10), 0.43F, 0.05F);
}

// One neighbour after the other, outward in pairs, along rows and then down columns.
Grid<float> blur_plainly(const Grid<float>& values, const Grid<float>& depth_m, double sigma,
                         int stride, PixelRect wanted) {
  std::vector<float> kernel;
  for (int k = 0; k <= static_cast<int>(std::ceil(3.0 * sigma / stride)); ++k)
    kernel.push_back(
        static_cast<float>(exact::exp(-0.5 * k * k / (sigma / stride * (sigma / stride)))));
  const auto pass = [&](const Grid<float>& in, int step_x, int step_y) {
    Grid<float> out(in.width(), in.height());
    for (const auto [x, y] : test::cells(in)) {
      float sum = kernel[0] * in(x, y);
      float total = kernel[0];
      for (int k = 1; k < static_cast<int>(kernel.size()); ++k)
        for (const int way : {-k, k}) {
          const int u = x + way * step_x;
          const int v = y + way * step_y;
          if (!in.contains(u, v) || !same_surface(depth_m(x, y), depth_m(u, v))) continue;
          sum += kernel[static_cast<std::size_t>(k)] * in(u, v);
          total += kernel[static_cast<std::size_t>(k)];
        }
      out(x, y) = sum / total;
    }
    return out;
  };
  Grid<float> blurred = pass(pass(values, stride, 0), 0, stride);
  for (const auto [x, y] : test::cells(values))
    if (x < wanted.x0 || y < wanted.y0 || x >= wanted.x1 || y >= wanted.y1) blurred(x, y) = 0.0F;
  return blurred;
}

TEST(PictureFilter, BlurOnASurfaceIsThatOfOnePixelAfterTheOther) {
  struct Case {
    int width, height;
    double sigma;
    int stride;
    PixelRect wanted;
  };
  for (const Case& c :
       {Case{61, 47, 2.3, 1, {0, 0, 61, 47}}, Case{61, 47, 1.0, 1, {3, 5, 60, 40}},
        Case{200, 90, 9.0, 1, {31, 11, 190, 90}}, Case{150, 160, 17.0, 2, {0, 40, 150, 160}},
        Case{9, 7, 5.0, 1, {0, 0, 9, 7}}, Case{300, 4, 40.0, 5, {20, 1, 280, 4}}}) {
    Grid<float> values(c.width, c.height);
    Grid<float> depth(c.width, c.height);
    for (const auto [x, y] : test::cells(c.width, c.height)) {
      values(x, y) = static_cast<float>(gaussian_noise(2, x, y, 1.5));
      depth(x, y) = gaussian_noise(3, x, y, 6.0) > 1.0
                        ? sky_depth_m
                        : 10000.F + 200.F * static_cast<float>(gaussian_noise(4, x, y, 4.0));
    }
    EXPECT_EQ(blur_on_surface(values, depth, c.sigma, c.wanted),
              blur_plainly(values, depth, c.sigma, c.stride, c.wanted))
        << c.sigma;
  }
}

TEST(PictureFilter, SurfacesPartAtThreeHundredthsOfTheNearerDistance) {
  EXPECT_TRUE(same_surface(10000.F, 10299.F));
  EXPECT_FALSE(same_surface(10000.F, 10301.F));
  EXPECT_FALSE(same_surface(10301.F, 10000.F));
  EXPECT_TRUE(same_surface(sky_depth_m, sky_depth_m));
  EXPECT_FALSE(same_surface(sky_depth_m, 1e9F));
}

TEST(PictureFilter, TheSkyTakesSkyOnly) {
  Grid<float> values(20, 20, 0.F);
  Grid<float> depth(20, 20, 10000.F);
  for (const auto [x, y] : test::cells(20, 10)) {
    values(x, y) = 5.F;
    depth(x, y) = sky_depth_m;
  }
  const Grid<float> blurred = blur_on_surface(values, depth, 2.0);
  for (int y = 0; y < 20; ++y) EXPECT_NEAR(blurred(7, y), y < 10 ? 5.F : 0.F, 1e-5F) << y;
}

// Kernels of all kinds: direct ones, and wide ones over cells of the whole picture.
TEST(PictureFilter, PartWithItsReachEqualsWhole) {
  for (const double sigma : {1.5, 12.0, 17.0, 30.0}) {
    const int reach = blur_reach_px(sigma);
    const int size = 2 * reach + 120;
    const Grid<float> whole =
        test::grid_of(size, size, [&](int x, int y) { return gaussian_noise(2, x, y, 5.0); });
    const PixelRect part{reach + 37, reach + 51, reach + 70, reach + 80};
    const PixelRect wide = test::with_margin(part, reach, size, size);
    const Grid<float> cut = blur_in_picture(test::cut(whole, wide), sigma, {wide.x0, wide.y0});
    EXPECT_EQ(test::cut(cut, {reach, reach, reach + part.width(), reach + part.height()}),
              test::cut(blur_in_picture(whole, sigma, {0, 0}), part))
        << sigma;
  }
}

// A wide view whose depth is the same everywhere.
GuidanceBuffers level_view(int width, int height) {
  return test::make_slope(width, height, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
}
constexpr int factor = 4;

TEST(PictureFilter, ARampIsEnlargedToARamp) {
  const GuidanceBuffers g = level_view(20, 16);
  const Grid<float> values = test::grid_of(20, 16, [&](int x, int y) { return 3 * x - 2 * y; });
  const WideView wide{g, factor, {100, 50}};
  const PixelRect rect{402, 203, 470, 258};  // inside the centres of the outer pixels
  const Grid<float> large = enlarge(wide, values, rect);
  for (const auto [x, y] : test::cells(large)) {
    const double u = (rect.x0 + x + 0.5) / factor - 0.5 - 100.0;
    const double v = (rect.y0 + y + 0.5) / factor - 0.5 - 50.0;
    ASSERT_NEAR(large(x, y), 3.0 * u - 2.0 * v, 1e-4);
    ASSERT_NEAR(value_on_surface(wide, values, rect.x0 + x, rect.y0 + y, 20000.0F),
                3.0 * u - 2.0 * v, 1e-4);
  }
}

TEST(PictureFilter, OfFactorOneItIsThePixelsThemselves) {
  const GuidanceBuffers g = test::make_hills(60, 50);
  const WideView wide{g, 1, {7, 9}};
  const PixelRect rect{11, 20, 40, 44};
  const Grid<float> same = enlarge(wide, g.slope_deg, rect);
  for (const auto [x, y] : test::cells(same)) {
    ASSERT_EQ(same(x, y), g.slope_deg(4 + x, 11 + y));
    ASSERT_EQ(value_on_surface(wide, g.slope_deg, 11 + x, 20 + y, g.depth_m(4 + x, 11 + y)),
              g.slope_deg(4 + x, 11 + y));
  }
  EXPECT_EQ(wide_rect(rect, 1), rect);
}

TEST(PictureFilter, NothingIsMixedAcrossASilhouette) {
  GuidanceBuffers g = level_view(8, 8);
  Grid<float> values(8, 8, 1.0F);
  for (const auto [x, y] : test::cells(8, 4)) {
    g.depth_m(x, y) = 50000.0F;
    values(x, y) = 0.0F;
  }
  const WideView wide{g, factor, {0, 0}};
  for (int y = 14; y < 18; ++y) {  // between the centres of the two rows
    EXPECT_EQ(value_on_surface(wide, values, 15, y, 20000.0F), 1.0F) << y;
    EXPECT_EQ(value_on_surface(wide, values, 15, y, 50000.0F), 0.0F) << y;
  }
  EXPECT_EQ(value_on_surface(wide, values, 15, 25, 35000.0F), 1.0F)
      << "on no surface that is seen: the pixel that holds it";
}

// Crests of rock rise above where the wide view saw them: with the value of the pixel that contains
// them, which shows the valley behind, light and cover of a crest would have steps of wide pixels.
TEST(PictureFilter, WhatRoseHasTheValuesOfItsSurfaceBeneath) {
  constexpr int ridge = surface_look_rows + 6;  // the first row of the near surface
  GuidanceBuffers g = level_view(8, ridge + 4);
  Grid<float> values(8, ridge + 4);
  for (const auto [x, y] : test::cells(8, ridge + 4)) {
    if (y < ridge) g.depth_m(x, y) = 50000.0F;
    values(x, y) = y < ridge ? -100.0F : static_cast<float>(x + 10 * (y - ridge));
  }
  const WideView wide{g, factor, {0, 0}};
  for (int rows = 1; rows <= surface_look_rows; ++rows)
    for (int x = 2; x < 30; ++x)
      ASSERT_NEAR(value_on_surface(wide, values, x, factor * (ridge - rows), 20000.0F),
                  (x + 0.5) / factor - 0.5, 1e-4)
          << x << " " << rows;
  EXPECT_EQ(value_on_surface(wide, values, 15, factor * (ridge - surface_look_rows) - 1, 20000.0F),
            -100.0F)
      << "no farther";
  // The same for what sank, and where wide pixels are the pixels themselves.
  EXPECT_EQ(value_on_surface(wide, values, 14, factor * (ridge + 2), 50000.0F), -100.0F);
  EXPECT_EQ(value_on_surface({g, 1, {0, 0}}, values, 5, ridge - 4, 20000.0F), 5.0F);
}

}  // namespace
}  // namespace belvedere
