#include "terrain/io/surface_raster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "terrain/deform/deform.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

const GeoTransform frame{680000.0, 5260000.0, 30.0, 30.0};

Grid<float> rough(int width, int height) {
  return test::grid_of(width, height, [&](int x, int y) {
    return 1000.F + 10.F * static_cast<float>((x * 7 + y * 13) % 11);
  });
}

TEST(SurfaceRaster, WhatStaysInPlanKeepsItsPosts) {
  const Grid<float> z = rough(50, 40);
  EXPECT_EQ(raster_of_moved(z, frame, [](glm::dvec3 p) { return p; }), z);
  const Grid<float> bent = raster_of_moved(
      z, frame, [](glm::dvec3 p) { return glm::dvec3(p.x, p.y, 2.0 * p.z - 100.0); });
  EXPECT_EQ(bent(17, 23), 2.F * z(17, 23) - 100.F);
}

TEST(SurfaceRaster, AShiftByWholeCellsMovesTheCells) {
  const Grid<float> z = rough(50, 40);
  const Grid<float> moved = raster_of_moved(
      z, frame, [](glm::dvec3 p) { return glm::dvec3(p.x + 90.0, p.y + 60.0, p.z); });
  for (const auto [x, y] : test::cells(50, 40))
    if (x < 3 || y >= 38) {
      EXPECT_TRUE(std::isnan(moved(x, y)));
    } else {
      EXPECT_EQ(moved(x, y), z(x - 3, y + 2)) << x << ' ' << y;
    }
}

TEST(SurfaceRaster, ATurnedPlaneIsThePlaneTurned) {
  // z rises to the east; rotated clockwise by 50° in the core it rises to azimuth 140°.
  const Grid<float> z = test::grid_of(101, 101, [&](int x, int) { return 2.0 * x; });
  DeformParameters p;
  const glm::dvec2 centre = frame.to_crs(50, 50);
  p.handles = {{.centre = centre, .rotate_deg = 50.0, .radius_m = 1400.0, .core_m = 700.0}};
  const Deformation deformation(p, {0.0, 0.0});
  const Grid<float> out =
      raster_of_moved(z, frame, [&](glm::dvec3 q) { return deformation.point(q); });
  const double c = std::cos(50.0 * M_PI / 180.0);
  const double s = std::sin(50.0 * M_PI / 180.0);
  for (int y = 35; y <= 65; ++y)
    for (int x = 35; x <= 65; ++x) {
      const double source =
          (x - 50) * c - (50 - y) * s;  // the post that came here lies 50° counter-clockwise
      EXPECT_NEAR(static_cast<double>(out(x, y)), 100.0 + 2.0 * source, 1e-3);
    }
  EXPECT_EQ(out(0, 0), z(0, 0));
  EXPECT_EQ(out(99, 3), z(99, 3));
}

TEST(SurfaceRaster, OverhangsKeepTheHighestAndVoidsStayVoids) {
  Grid<float> z = test::grid_of(60, 20, [&](int x, int) { return x < 30 ? 500.F : 100.F; });
  z(45, 10) = std::nanf("");
  // The western half overlaps the eastern one by 10 cells.
  const auto push = [](glm::dvec3 p) {
    return glm::dvec3(p.z > 300.0 ? p.x + 300.0 : p.x, p.y, p.z);
  };
  const Grid<float> out = raster_of_moved(z, frame, push);
  for (int x = 10; x < 40; ++x) EXPECT_EQ(out(x, 5), 500.F) << x;
  for (int x = 40; x < 60; ++x) EXPECT_EQ(out(x, 5), 100.F) << x;
  EXPECT_TRUE(std::isnan(out(5, 5)));
  EXPECT_TRUE(std::isnan(out(45, 10)));
  EXPECT_EQ(out(43, 10), 100.F);
}

TEST(SurfaceRaster, SameBitsForAnyThreadCount) {
  const Grid<float> z = rough(150, 200);
  DeformParameters p;
  p.handles = {{.centre = frame.to_crs(70, 90),
                .move_m = {333.0, -121.0},
                .rotate_deg = 77.0,
                .radius_m = 2000.0,
                .core_m = 500.0}};
  const Deformation deformation(p, {0.0, 0.0});
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    Grid<float> out = raster_of_moved(z, frame, [&](glm::dvec3 q) { return deformation.point(q); });
    for (float& v : out)
      if (std::isnan(v)) v = -1.F;
    return out;
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace belvedere
