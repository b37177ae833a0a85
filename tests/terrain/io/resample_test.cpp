#include "terrain/io/resample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "terrain/io/crs.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

double bumps(double x, double y) { return 100.0 * std::sin(1.3 * x) * std::cos(0.9 * y); }

TEST(Resampler, CopiesCellsToTheBitWhereTheyCoincide) {
  const Grid<float> cells = test::grid_of(12, 9, bumps);
  for (const double scale : {0.3, 1.0, 1.0005}) {
    const Resampler resampler({scale, scale});
    for (const auto [x, y] : test::cells(12, 9))
      ASSERT_EQ(resampler.sample(cells, {x, y}), cells(x, y)) << scale << ' ' << x << ' ' << y;
  }
}

// Keys 1981: with a = -1/2 polynomials of the second degree are reproduced. Here they have no
// extremum nearby, where the range would clamp.
TEST(Resampler, ReproducesParabolas) {
  const auto parabola = [](double x, double y) {
    return 3.0 + 2.0 * x + 0.5 * y + 0.25 * x * x + 0.125 * y * y;
  };
  const Grid<float> cells = test::grid_of(12, 12, parabola);
  const Resampler resampler({1.0, 1.0});
  for (const double x : {4.0, 4.25, 5.5, 6.9})
    for (const double y : {3.1, 5.0, 6.5})
      EXPECT_NEAR(resampler.sample(cells, {x, y}), parabola(x, y), 1e-5) << x << ' ' << y;
}

TEST(Resampler, NeverLeavesTheRangeOfItsCells) {
  const Grid<float> shore = test::grid_of(12, 12, [](int x, int) { return x < 6 ? 400.0 : 900.0; });
  for (const double scale : {1.0, 1.7, 3.0}) {
    const Resampler resampler({scale, scale});
    for (double x = 3.0; x < 9.0; x += 0.05) {
      const float value = resampler.sample(shore, {x, 5.5});
      if (std::isnan(value)) continue;
      EXPECT_GE(value, 400.F);
      EXPECT_LE(value, 900.F);
    }
  }
}

TEST(Resampler, AveragesWhatIsFinerThanItsSamples) {
  // Stripes one cell wide, across which four cells make a sample: their mean; along them nothing is
  // averaged.
  const Grid<float> stripes = test::grid_of(40, 40, [](int x, int) { return x % 2; });
  EXPECT_NEAR(Resampler({4.0, 1.0}).sample(stripes, {20.0, 20.0}), 0.5, 0.02);
  EXPECT_NEAR(Resampler({4.0, 1.0}).sample(stripes, {21.0, 20.0}), 0.5, 0.02);
  EXPECT_EQ(Resampler({1.0, 4.0}).sample(stripes, {21.0, 20.0}), 1.F);
}

TEST(Resampler, BesideVoidsTakesTheMeanOfWhatIsKnown) {
  Grid<float> cells = test::grid_of(12, 12, [](int, int) { return 7.0; });
  for (const auto [x, y] : test::cells({6, 0, 12, 12})) cells(x, y) = NAN;
  const Resampler resampler({1.0, 1.0});
  EXPECT_EQ(resampler.sample(cells, {5.0, 5.0}), 7.F) << "on a centre";
  EXPECT_EQ(resampler.sample(cells, {5.4, 5.0}), 7.F) << "more than half of the tent is known";
  EXPECT_TRUE(std::isnan(resampler.sample(cells, {5.6, 5.0}))) << "less than half is";
  EXPECT_TRUE(std::isnan(resampler.sample(cells, {7.0, 5.0})));
}

TEST(Resampler, KnowsNothingOutside) {
  const Grid<float> cells = test::grid_of(12, 9, bumps);
  const Resampler resampler({1.0, 1.0});
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const glm::dvec2 at :
       {glm::dvec2{-1.0, 4.0}, glm::dvec2{12.0, 4.0}, glm::dvec2{4.0, 9.0}, glm::dvec2{1e300, 4.0},
        glm::dvec2{4.0, -infinity}, glm::dvec2{std::nan(""), 4.0}})
    EXPECT_TRUE(std::isnan(resampler.sample(cells, at))) << at.x << ' ' << at.y;
}

// Window readers rely on the reach: cells beyond it have no effect.
TEST(Resampler, LooksNoFurtherThanItsReach) {
  for (const double scale : {1.0, 1.5, 3.2}) {
    const Resampler resampler({scale, 1.0});
    const glm::ivec2 reach = resampler.reach();
    const Grid<float> cells = test::grid_of(40, 40, bumps);
    for (const double x : {20.0, 20.3, 20.99}) {
      Grid<float> other = cells;
      for (const auto [u, v] : test::cells(40, 40))
        if (std::abs(u - x) > reach.x || std::abs(v - 20.4) > reach.y) other(u, v) = NAN;
      EXPECT_EQ(resampler.sample(other, {x, 20.4}), resampler.sample(cells, {x, 20.4}))
          << scale << ' ' << x;
    }
  }
}

TEST(SampleNearest, TakesTheCellThatHoldsThePlace) {
  Grid<std::int32_t> codes(3, 2);
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = static_cast<std::int32_t>(10 + i);
  EXPECT_EQ(sample_nearest(codes, {0.0, 0.0}), 10);
  EXPECT_EQ(sample_nearest(codes, {-0.5, -0.5}), 10);
  EXPECT_EQ(sample_nearest(codes, {0.49, 0.51}), 13);
  EXPECT_EQ(sample_nearest(codes, {2.49, 1.49}), 15);
  for (const glm::dvec2 at : {glm::dvec2{-0.51, 0.0}, glm::dvec2{2.5, 0.0}, glm::dvec2{0.0, 1.5},
                              glm::dvec2{1e300, 0.0}, glm::dvec2{std::nan(""), 0.0}})
    EXPECT_EQ(sample_nearest(codes, at), -1) << at.x << ' ' << at.y;
}

constexpr char utm32[] = "EPSG:32632";

CellAffine upright(double west, double north, double cell) {
  CellAffine affine{.x0 = west, .y0 = north};
  affine.x_column = cell;
  affine.y_row = -cell;
  return affine;
}

RasterFrame utm_frame(GeoTransform transform, int width, int height) {
  return {.transform = transform, .width = width, .height = height, .crs = normalize_crs(utm32)};
}

TEST(LatticeMap, CellsThatCoincideAreWholeNumbers) {
  // The frame begins 4 cells to the east and 7 to the south of the source.
  const LatticeMap map(
      upright(600000.0, 5200000.0, 30.0), normalize_crs(utm32), {601000.0, 5199000.0},
      utm_frame({600000.0 + 4 * 30.0, 5200000.0 - 7 * 30.0, 30.0, 30.0}, 200, 100));
  ASSERT_TRUE(map.offset().has_value());
  EXPECT_EQ(*map.offset(), glm::ivec2(4, 7));
  EXPECT_EQ(map(0, 0), glm::dvec2(4.0, 7.0));
  EXPECT_EQ(map(199, 99), glm::dvec2(203.0, 106.0));
  EXPECT_NEAR(map.scale().x, 1.0, 1e-12);
}

TEST(LatticeMap, AWindowCountsFromItsCorner) {
  LatticeMap map(upright(600000.0, 5200000.0, 30.0), normalize_crs(utm32), {601000.0, 5199000.0},
                 utm_frame({600021.0, 5199979.0, 20.0, 20.0}, 300, 300));
  EXPECT_FALSE(map.offset().has_value());
  EXPECT_NEAR(map.scale().x, 20.0 / 30.0, 1e-12);
  const glm::dvec2 whole = map(130, 210);
  map.begin_at({100, 200});
  EXPECT_EQ(map(30, 10), whole) << "to the bit";
}

TEST(LatticeMap, ReprojectionIsExactToAThousandthOfACell) {
  const std::string degrees = normalize_crs("EPSG:4326");
  const double cell = 1.0 / 3600.0;
  const RasterFrame metric = utm_frame({600000.0, 5200000.0, 30.0, 30.0}, 500, 500);
  const LatticeMap map(upright(10.0, 47.5, cell), degrees, {10.4, 46.9}, metric);
  double worst = 0.0;
  for (int y = 3; y < 500; y += 29)
    for (int x = 5; x < 500; x += 31) {
      const glm::dvec2 position =
          transform_point(metric.crs, degrees, metric.transform.to_crs(x, y));
      const glm::dvec2 exact{(position.x - 10.0) / cell - 0.5, (47.5 - position.y) / cell - 0.5};
      worst = std::max(worst, glm::distance(map(x, y), exact));
    }
  EXPECT_LT(worst, 1e-3);
}

TEST(LatticeMap, LongitudesAreCountedNearTheSource) {
  // Fiji's zone, a source whose degrees go on beyond 180.
  const std::string degrees = normalize_crs("EPSG:4326");
  RasterFrame metric = utm_frame({800000.0, 8200000.0, 100.0, 100.0}, 400, 100);
  metric.crs = normalize_crs("EPSG:32760");
  const LatticeMap map(upright(179.0, -16.0, 0.001), degrees, {180.0, -16.3}, metric);
  for (const int x : {0, 200, 399}) {
    double longitude = transform_point(metric.crs, degrees, metric.transform.to_crs(x, 50)).x;
    if (longitude < 0.0) longitude += 360.0;
    EXPECT_NEAR(map(x, 50).x, (longitude - 179.0) / 0.001 - 0.5, 0.01) << x;
  }
}

}  // namespace
}  // namespace belvedere
