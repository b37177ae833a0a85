#include "terrain/generalize/mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "terrain/generalize/generalize.h"
#include "tests/grids.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

class MaskFile : public RasterFiles {
 protected:
  // 20 × 12 cells of 30 m.
  const RasterFrame frame_{{500000.0, 5200360.0, 30.0, 30.0}, 20, 12, "EPSG:32632"};
  template <class F>
  RasterSource mask_of(F&& value, double cell = 30.0, int width = 20, int height = 12,
                       const std::string& nodata = "") const {
    write_ascii(
        "mask.asc", width, height, 500000.0, 5200360.0 - cell * height, cell,
        [&](int x, int y) { return std::to_string(value(x, y)); }, nodata);
    RasterSource source;
    source.path = path("mask.asc");
    source.crs = "EPSG:32632";
    return source;
  }
  Grid<float> read(const RasterSource& source) const {
    return read_mask(source, frame_, silent_progress());
  }
};

TEST(ClassMask, TakesEachClassAtItsShare) {
  GeneralizedShares shares;
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = static_cast<float>(i) / 16.F;
  Grid<LandCoverClass> classes(land_cover_class_count, 2);
  for (int x = 0; x < classes.width(); ++x)
    for (int y = 0; y < 2; ++y) classes(x, y) = static_cast<LandCoverClass>(x);
  const Grid<float> mask = class_mask(classes, shares);
  ASSERT_EQ(mask.width(), land_cover_class_count);
  for (int x = 0; x < classes.width(); ++x) EXPECT_EQ(mask(x, 1), static_cast<float>(x) / 16.F);
  EXPECT_EQ(mask(static_cast<int>(LandCoverClass::glacier), 0), 9.F / 16.F);
}

TEST_F(MaskFile, ReadsSharesAndGreyValues) {
  const Grid<float> shares = read(mask_of([](int x, int y) { return (x + y) % 5 / 4.0; }));
  const Grid<float> grey = read(mask_of([](int x, int y) { return (x + y) % 6 * 51; }));
  for (const auto [x, y] : test::cells(20, 12)) {
    ASSERT_FLOAT_EQ(shares(x, y), static_cast<float>((x + y) % 5) / 4.F);
    ASSERT_FLOAT_EQ(grey(x, y), static_cast<float>((x + y) % 6) / 5.F);
  }
}

TEST_F(MaskFile, WithoutDataIsGeneralized) {
  // Declared voids in the west, and a file that ends after 10 columns.
  const Grid<float> mask =
      read(mask_of([](int x, int) { return x < 4 ? -1 : 0; }, 30.0, 10, 12, "-1"));
  EXPECT_EQ(mask(1, 5), 1.F);
  EXPECT_EQ(mask(7, 5), 0.F);
  EXPECT_EQ(mask(15, 5), 1.F);
}

TEST_F(MaskFile, HardEdgesOnOtherCellsStayInTheirRange) {
  // Resampling must not produce values below 0 or above 1: the mask would be rejected, or read as
  // one of 0…255.
  for (const double cell : {50.0, 20.0, 7.0})
    for (const double max : {1.0, 255.0}) {
      const int width = static_cast<int>(600.0 / cell) + 1;
      const int height = static_cast<int>(360.0 / cell) + 1;
      const Grid<float> mask = read(
          mask_of([&](int x, int) { return x * cell < 300.0 ? max : 0.0; }, cell, width, height));
      for (const float v : mask) {
        ASSERT_GE(v, 0.F);
        ASSERT_LE(v, 1.F);
      }
      EXPECT_NEAR(mask(4, 6), 1.F, 1e-6F) << cell << ' ' << max;
      EXPECT_NEAR(mask(16, 6), 0.F, 1e-6F) << cell << ' ' << max;
    }
}

TEST_F(MaskFile, SaysWhatIsWrong) {
  const auto message = [&](const RasterSource& source) {
    return test::input_error([&] { read(source); });
  };
  EXPECT_NE(message(mask_of([](int, int) { return 300; })).find("300"), std::string::npos);
  EXPECT_NE(message(mask_of([](int x, int) { return x == 3 ? -2 : 1; })).find("-2"),
            std::string::npos);
  EXPECT_NE(
      message(mask_of([](int, int) { return -1; }, 30.0, 20, 12, "-1")).find("does not cover"),
      std::string::npos);
}

TEST_F(MaskFile, SlopeAndDrawnMaskProtectTogether) {
  // Waves 40 cells long in the east; the west is a plain with small bumps, which the slope mask
  // keeps. The drawn mask keeps the south.
  const int size = 160;
  Grid<float> terrain(size, size);
  for (const auto [x, y] : test::cells(size, size)) {
    const double rise = std::clamp((x - 70.0) / 10.0, 0.0, 1.0);
    terrain(x, y) = static_cast<float>(1000.0 + 0.2 * std::sin(x * 0.9) * std::sin(y * 0.8) +
                                       rise * (25.0 * x + 60.0 * std::sin(y * 0.5)));
  }
  RasterFrame frame = frame_;
  frame.width = frame.height = size;
  const RasterSource source =
      mask_of([](int, int y) { return y < 80 ? 255 : 0; }, 30.0, size, size);
  const Grid<float> slope = slope_mask(terrain, {30.0, 30.0}, {});
  const Grid<float> drawn = read_mask(source, frame, silent_progress());
  const auto run = [&](const Grid<float>& mask) {
    GeneralizeGrids grids;
    grids.mask = mask;
    GeneralizeParameters p;
    p.foreground = p.background = {1.F, .5F, 0.F};
    return generalize(terrain, {30.0, 30.0}, grids, p, silent_progress());
  };
  const Grid<float> all = run({});
  const Grid<float> both = run(combine_masks(slope, drawn));
  // Means of the change, each within one of the four quarters, away from their edges.
  const auto change = [&](const Grid<float>& out, int x0, int y0) {
    double sum = 0.0;
    for (const auto [x, y] : test::cells({x0, y0, x0 + 40, y0 + 40}))
      sum += std::abs(static_cast<double>(out(x, y)) - terrain(x, y));
    return sum / 1600.0;
  };
  const int west = 10, east = 105, north = 15, south = 105;
  EXPECT_GT(change(all, west, north), 0.02);
  EXPECT_EQ(change(both, west, north), 0.0);                               // by the slope index
  EXPECT_EQ(change(both, west, south), 0.0);                               // by both
  EXPECT_EQ(change(both, east, south), 0.0);                               // as drawn
  EXPECT_NEAR(change(both, east, north), change(all, east, north), 1e-2);  // by neither
  EXPECT_GT(change(all, east, north), 5.0);
  // Each of them alone leaves a quarter that the other keeps.
  EXPECT_GT(change(run(slope), east, south), 5.0);
  EXPECT_GT(change(run(drawn), west, north), 0.02);
}

TEST(CombineMasks, IsTheProductAndTakesEmptyForOne) {
  const Grid<float> a(3, 2, .5F);
  const Grid<float> b(3, 2, .25F);
  EXPECT_EQ(combine_masks(a, b), Grid<float>(3, 2, .125F));
  EXPECT_EQ(combine_masks({}, b), b);
  EXPECT_EQ(combine_masks(a, {}), a);
  EXPECT_EQ(test::error_of([&] { combine_masks(a, Grid<float>(2, 3)); }).kind(), ErrorKind::bug);
}

TEST(ApplyMask, KeepsTheBitsOfZeroAndBlendsBetween) {
  Grid<float> before(4, 1);
  Grid<float> after(4, 1);
  Grid<float> mask(4, 1);
  for (int x = 0; x < 4; ++x) {
    before(x, 0) = 0.1F + 1000.F * static_cast<float>(x);
    after(x, 0) = before(x, 0) + 40.3F;
  }
  mask(1, 0) = 0.25F;
  mask(2, 0) = 1.F;
  mask(3, 0) = -0.01F;  // a pyramid may leave the range
  const Grid<float> out = apply_mask(before, after, mask);
  EXPECT_EQ(out(0, 0), before(0, 0));
  EXPECT_NEAR(out(1, 0), before(1, 0) + 0.25F * 40.3F, 1e-3F);
  EXPECT_EQ(out(2, 0), after(2, 0));
  EXPECT_EQ(out(3, 0), before(3, 0));
  EXPECT_EQ(apply_mask(before, after, {}), after);
}

TEST(SoftenMask, LeavesZeroWhereItWas) {
  const Grid<float> hard = test::grid_of(
      60, 40, [&](int x, int y) { return x < 30 && !(x == 12 && y == 20) ? 1.F : 0.F; });
  const Grid<float> soft = soften_mask(hard);
  for (std::size_t i = 0; i < hard.size(); ++i) {
    if (hard[i] == 0.F) {
      ASSERT_EQ(soft[i], 0.F) << i;
    }
    ASSERT_LE(soft[i], 1.F + 1e-6F);
  }
  EXPECT_LT(soft(29, 5), 0.1F);
  EXPECT_GT(soft(22, 5), 0.85F);
  EXPECT_NEAR(soft(5, 5), 1.F, 1e-5F);
}

TEST(ForegroundShare, ReachesItsValuesAtTheDistancesGiven) {
  const auto at = [](double t) { return foreground_share(2000.0 + 8000.0 * t, 2000.0, 10000.0); };
  for (const double t : {-0.25, -0.125, -1e-6, 0.0}) EXPECT_EQ(at(t), 1.0) << t;
  for (const double t : {1.0, 1.0 + 1e-6, 1.125, 100.0}) EXPECT_EQ(at(t), 0.0) << t;
  EXPECT_LT(at(1e-3), 1.0);
  EXPECT_GT(at(1.0 - 1e-3), 0.0);
  EXPECT_EQ(at(0.5), 0.5);
  // 1 - 4 s t² with the slope s = 8/7 to an eighth, the line 1/2 - s (t - 1/2), and its mirror
  // image.
  for (const double t : {0.03, 0.1, 0.125}) {
    EXPECT_NEAR(at(t), 1.0 - 32.0 / 7.0 * t * t, 1e-12) << t;
    EXPECT_NEAR(at(1.0 - t), 32.0 / 7.0 * t * t, 1e-12) << t;
  }
  for (const double t : {0.125, 0.3, 0.5, 0.7, 0.875})
    EXPECT_NEAR(at(t), 0.5 - 8.0 / 7.0 * (t - 0.5), 1e-12) << t;
}

TEST(ForegroundShare, IsHardlySteeperThanALineAndHasNoCrease) {
  const double step = 1e-3;
  double slope = 0.0;
  for (double t = -0.5; t < 1.5; t += step) {
    const double next =
        (foreground_share(t, 0.0, 1.0) - foreground_share(t + step, 0.0, 1.0)) / step;
    EXPECT_GE(next, 0.0) << t;
    EXPECT_LE(next, 8.0 / 7.0 + 1e-9) << t;
    EXPECT_LE(std::abs(next - slope), 1.01 * step * 64.0 / 7.0)
        << t;  // the slope turns by no more than the parabola's
    slope = next;
  }
}

}  // namespace
}  // namespace belvedere
