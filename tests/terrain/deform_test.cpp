#include "terrain/deform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/base/parallel.h"

namespace belvedere {
namespace {

// 40 × 30 cells of 30 m in UTM zone 32, gently rough.
const GeoTransform innsbruck{680000.0, 5260000.0, 30.0, 30.0};

Grid<float> hills() {
  Grid<float> grid(40, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) grid(x, y) = 1500.F + 37.123F * static_cast<float>((x * 7 + y * 13) % 11);
  }
  return grid;
}

DeformParameters panorama() {
  DeformParameters p;
  p.exaggeration = 1.6;
  p.bend = {140000.0, 82000.0, 78000.0, 6e-6};
  p.earth_curvature = true;
  return p;
}

TEST(Deform, NothingAskedIsTheIdentity) {
  const Grid<float> altitude = hills();
  const glm::dvec3 origin(690000.0, 5250000.0, 0.0);
  const DeformedSurface surface = deform(altitude, innsbruck, {691000.0, 5302000.0}, origin, {});
  EXPECT_EQ(surface.origin, origin);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      const glm::dvec2 place = innsbruck.to_crs(x, y);
      ASSERT_EQ(surface.vertices_m(x, y), glm::vec3(place.x - origin.x, place.y - origin.y, altitude(x, y)));
    }
  }
  const glm::dvec3 point(123.25, -9.5, 777.125);
  EXPECT_EQ(deform_point(point, {0.0, 0.0}, {}), point);
}

TEST(Deform, BendIsItsFormula) {
  const DeformParameters p = [] {
    DeformParameters q = panorama();
    q.earth_curvature = false;
    return q;
  }();
  EXPECT_DOUBLE_EQ(bend_drop_m(p, 82000.0), 6e-6 * 4000.0 * 4000.0);
  EXPECT_DOUBLE_EQ(bend_drop_m(p, 22000.0), 60000.0 * 60000.0 / 280000.0);
  EXPECT_DOUBLE_EQ(bend_drop_m(p, 100000.0), 18000.0 * 18000.0 / 280000.0 + 6e-6 * 22000.0 * 22000.0);
  // 3 km east and 4 km north of the viewer: 5 km, in any direction alike.
  EXPECT_DOUBLE_EQ(deform_point({3000.0, 4000.0, 1000.0}, {0.0, 0.0}, p).z, 1600.0 - 77000.0 * 77000.0 / 280000.0);
  EXPECT_DOUBLE_EQ(deform_point({-4000.0, 3000.0, 1000.0}, {0.0, 0.0}, p).z, 1600.0 - 77000.0 * 77000.0 / 280000.0);
}

TEST(Deform, EarthCurvatureDropsAsSurveyorsTable) {
  DeformParameters p;
  p.earth_curvature = true;
  p.refraction = 0.0;
  EXPECT_NEAR(bend_drop_m(p, 10000.0), 7.848, 0.001);  // d² / 2R
  EXPECT_NEAR(bend_drop_m(p, 100000.0), 784.8, 0.1);
  p.refraction = 0.13;
  EXPECT_NEAR(bend_drop_m(p, 100000.0), 682.8, 0.1);
  // It is not exaggerated, altitudes are.
  p.exaggeration = 2.0;
  EXPECT_NEAR(deform_point({100000.0, 0.0, 500.0}, {0.0, 0.0}, p).z, 1000.0 - 682.8, 0.1);
  EXPECT_EQ(bend_drop_m(p, 0.0), 0.0);
}

TEST(Deform, BendIsSmoothWhereTheFarTermBegins) {
  DeformParameters p = panorama();
  p.bend.radius_m = 0.0;
  p.earth_curvature = false;
  EXPECT_EQ(bend_drop_m(p, 78000.0), 0.0);
  EXPECT_NEAR(bend_drop_m(p, 78001.0), 6e-6, 1e-12);
}

TEST(Deform, VertexEqualsDeformPoint) {
  const Grid<float> altitude = hills();
  const glm::dvec2 viewer(691234.5, 5302017.25);
  const glm::dvec3 origin(viewer, 0.0);
  const DeformParameters p = panorama();
  const DeformedSurface surface = deform(altitude, innsbruck, viewer, origin, p);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      const glm::dvec3 point = deform_point({innsbruck.to_crs(x, y), altitude(x, y)}, viewer, p);
      ASSERT_EQ(surface.vertices_m(x, y), glm::vec3(point - origin)) << x << ' ' << y;
    }
  }
}

TEST(Deform, UtmCoordinatesKeepCentimetres) {
  // 42 km from the origin and 5,260 km from the equator, a vertex must still lie within half a centimetre.
  const Grid<float> altitude = hills();
  const glm::dvec2 viewer(691234.56, 5302017.89);
  const DeformParameters p = panorama();
  const DeformedSurface surface = deform(altitude, innsbruck, viewer, glm::dvec3(viewer, 0.0), p);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      const glm::dvec3 exact = deform_point({innsbruck.to_crs(x, y), altitude(x, y)}, viewer, p);
      const glm::dvec3 stored = glm::dvec3(surface.vertices_m(x, y)) + surface.origin;
      ASSERT_LT(std::abs(stored.x - exact.x), 0.005);
      ASSERT_LT(std::abs(stored.y - exact.y), 0.005);
      ASSERT_LT(std::abs(stored.z - exact.z), 0.005);
    }
  }
}

TEST(Deform, SameBitsForAnyThreadCount) {
  const Grid<float> altitude = hills();
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return deform(altitude, innsbruck, {691000.0, 5302000.0}, {691000.0, 5302000.0, 0.0}, panorama()).vertices_m;
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace belvedere
