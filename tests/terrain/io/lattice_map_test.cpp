#include "terrain/io/lattice_map.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "terrain/io/crs.h"

namespace belvedere {
namespace {

constexpr char utm32[] = "EPSG:32632";

CellAffine upright(double west, double north, double cell) {
  CellAffine affine;
  affine.x0 = west;
  affine.y0 = north;
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
