#include "terrain/deform/deform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/math.h"
#include "base/parallel.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// 40 × 30 cells of 30 m in UTM zone 32, gently rough.
const GeoTransform innsbruck{680000.0, 5260000.0, 30.0, 30.0};

Grid<float> hills() {
  return test::grid_of(40, 30, [&](int x, int y) {
    return 1500.F + 37.123F * static_cast<float>((x * 7 + y * 13) % 11);
  });
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
  for (const auto [x, y] : test::cells(40, 30)) {
    const glm::dvec2 position = innsbruck.to_crs(x, y);
    ASSERT_EQ(surface.vertices_m(x, y),
              glm::vec3(position.x - origin.x, position.y - origin.y, altitude(x, y)));
  }
  const glm::dvec3 point(123.25, -9.5, 777.125);
  EXPECT_EQ(Deformation({}, {}).point(point), point);
}

TEST(Deform, BendIsItsFormula) {
  const DeformParameters p = [] {
    DeformParameters q = panorama();
    q.earth_curvature = false;
    return q;
  }();
  EXPECT_DOUBLE_EQ(Deformation(p, {}).drop_m(82000.0), 6e-6 * 4000.0 * 4000.0);
  EXPECT_DOUBLE_EQ(Deformation(p, {}).drop_m(22000.0), 60000.0 * 60000.0 / 280000.0);
  EXPECT_DOUBLE_EQ(Deformation(p, {}).drop_m(100000.0),
                   18000.0 * 18000.0 / 280000.0 + 6e-6 * 22000.0 * 22000.0);
  // 3 km east and 4 km north of the viewer: 5 km, in any direction alike.
  EXPECT_DOUBLE_EQ(Deformation(p, {}).point({3000.0, 4000.0, 1000.0}).z,
                   1600.0 - 77000.0 * 77000.0 / 280000.0);
  EXPECT_DOUBLE_EQ(Deformation(p, {}).point({-4000.0, 3000.0, 1000.0}).z,
                   1600.0 - 77000.0 * 77000.0 / 280000.0);
}

TEST(Deform, EarthCurvatureDropsAsSurveyorsTable) {
  DeformParameters p;
  p.earth_curvature = true;
  p.refraction = 0.0;
  EXPECT_NEAR(Deformation(p, {}).drop_m(10000.0), 7.848, 0.001);  // d² / 2R
  EXPECT_NEAR(Deformation(p, {}).drop_m(100000.0), 784.8, 0.1);
  p.refraction = 0.13;
  EXPECT_NEAR(Deformation(p, {}).drop_m(100000.0), 682.8, 0.1);
  // It is not exaggerated; altitudes are.
  p.exaggeration = 2.0;
  EXPECT_NEAR(Deformation(p, {}).point({100000.0, 0.0, 500.0}).z, 1000.0 - 682.8, 0.1);
  EXPECT_EQ(Deformation(p, {}).drop_m(0.0), 0.0);
}

TEST(Deform, BendIsSmoothWhereTheFarTermBegins) {
  DeformParameters p = panorama();
  p.bend.radius_m = 0.0;
  p.earth_curvature = false;
  EXPECT_EQ(Deformation(p, {}).drop_m(78000.0), 0.0);
  EXPECT_NEAR(Deformation(p, {}).drop_m(78001.0), 6e-6, 1e-12);
}

// All effects at once, to compare points with vertices, and numbers of threads.
DeformParameters rearranged() {
  DeformParameters p = panorama();
  p.background_exaggeration = 1.2;
  p.foreground_to_m = 41000.0;
  p.background_from_m = 42500.0;
  p.summits = {{{680600.0, 5259600.0}, 500.0, 1.4, 1500.0}};
  p.handles = {
      {.centre = {680500.0, 5259500.0},
       .move_m = {40.0, 15.0},
       .rotate_deg = 50.0,
       .radius_m = 400.0,
       .core_m = 120.0},
      {.centre = {680900.0, 5259300.0}, .raise_m = 80.0, .radius_m = 300.0, .core_m = 50.0}};
  return p;
}

// Also 42 km from the origin and 5,260 km from the equator, where a vertex must still lie within
// half a centimetre.
TEST(Deform, VertexEqualsItsPoint) {
  const Grid<float> altitude = hills();
  const glm::dvec2 viewer(691234.56, 5302017.89);
  for (const bool everything : {false, true}) {
    const DeformParameters p = everything ? rearranged() : panorama();
    const DeformedSurface surface = deform(altitude, innsbruck, viewer, glm::dvec3(viewer, 0.0), p);
    int moved = 0;
    for (const auto [x, y] : test::cells(40, 30)) {
      const glm::dvec3 from(innsbruck.to_crs(x, y), altitude(x, y));
      const glm::dvec3 exact = Deformation(p, viewer).point(from);
      const glm::vec3 vertex = surface.vertices_m(x, y);
      ASSERT_EQ(vertex, glm::vec3(exact - surface.origin)) << x << ' ' << y;
      const glm::dvec3 off = glm::abs(glm::dvec3(vertex) + surface.origin - exact);
      ASSERT_LT(std::max({off.x, off.y, off.z}), 0.005);
      moved += exact.x != from.x ? 1 : 0;
    }
    EXPECT_GE(moved, everything ? 101 : 0);
    EXPECT_LT(moved, everything ? 1000 : 1);
  }
}

TEST(Deform, ExaggerationIsExactAtBothEndsAndSmoothBetween) {
  DeformParameters p;
  p.exaggeration = 1.7;
  p.background_exaggeration = 1.1;
  p.foreground_to_m = 20000.0;
  p.background_from_m = 60000.0;
  p.exaggeration_base_m = 600.0;
  const auto height = [&](double d) { return Deformation(p, {}).point({0.0, d, 1600.0}).z; };
  EXPECT_EQ(height(0.0), 600.0 + 1.7 * 1000.0);
  EXPECT_EQ(height(20000.0), 600.0 + 1.7 * 1000.0);
  EXPECT_EQ(height(60000.0), 600.0 + 1.1 * 1000.0);
  EXPECT_EQ(height(150000.0), 600.0 + 1.1 * 1000.0);
  EXPECT_DOUBLE_EQ(height(40000.0), 600.0 + 1.4 * 1000.0);
  for (const double edge : {20000.0, 60000.0})
    EXPECT_NEAR(height(edge + 10.0), height(edge - 10.0), 0.01);
  for (double d = 20000.0; d < 60000.0; d += 500.0) EXPECT_LT(height(d + 500.0), height(d));
  // The base keeps its height everywhere.
  EXPECT_EQ(Deformation(p, {}).point({0.0, 40000.0, 600.0}).z, 600.0);
}

TEST(Deform, ExaggerationByDistancePassesThroughItsPoints) {
  DeformParameters p;
  p.exaggeration = 1.5;
  p.exaggeration_base_m = 500.0;
  p.exaggeration_points = {{10000.0, 1.2}, {30000.0, 0.8}, {50000.0, 0.8}};
  const Deformation deformation(p, {0.0, 0.0});
  EXPECT_TRUE(deformation.is_local());
  const auto height = [&](double d) { return deformation.point({0.0, d, 1500.0}).z; };
  EXPECT_NEAR(height(1000.0), 500.0 + 1.5 * 1.2 * 1000.0, 1e-9);
  EXPECT_NEAR(height(10000.0), 500.0 + 1.5 * 1.2 * 1000.0, 1e-9);
  EXPECT_NEAR(height(30000.0), 500.0 + 1.5 * 0.8 * 1000.0, 1e-9);
  EXPECT_NEAR(height(90000.0), 500.0 + 1.5 * 0.8 * 1000.0, 1e-9);
  EXPECT_LT(height(20000.0), height(12000.0));
  p.exaggeration_points[1].distance_m = 10000.5;
  EXPECT_THROW(Deformation(p, {0.0, 0.0}), Error);
}

// A place 20 km to the north-east, known exactly, moves to the right as seen from the viewer and
// up.
TEST(Deform, AFieldTurnsAboutTheViewerAndRaisesAfterExaggeration) {
  const glm::dvec2 viewer(600000.0, 5200000.0);
  const double distance = 20000.0;
  const glm::dvec2 place = viewer + distance * glm::dvec2(0.6, 0.8);
  DeformParameters p;
  p.exaggeration = 2.0;
  p.exaggeration_base_m = 400.0;
  p.bend.radius_m = 100000.0;
  p.field.places = {{place, {300.0, 120.0}, {1e-4, 1e-4}}};
  const Deformation deformation(p, viewer);
  const glm::dvec3 moved = deformation.point({place, 1400.0});
  const double angle = std::atan2(0.6, 0.8) + 300.0 / distance;  // clockwise from north
  EXPECT_NEAR(moved.x, viewer.x + distance * std::sin(angle), 1e-3);
  EXPECT_NEAR(moved.y, viewer.y + distance * std::cos(angle), 1e-3);
  EXPECT_NEAR(moved.z, 400.0 + 2.0 * 1000.0 + 120.0 - distance * distance / 200000.0, 1e-3);
  EXPECT_TRUE(deformation.moves_in_plan());
  EXPECT_TRUE(deformation.is_local());
  const auto source = deformation.source_of(glm::dvec2(moved));
  ASSERT_TRUE(source);
  EXPECT_LT(glm::length(*source - place), 0.01);
  // Far from the place nothing moves.
  const glm::dvec3 far(viewer + glm::dvec2(-150000.0, 0.0), 900.0);
  EXPECT_EQ(glm::dvec2(deformation.rearranged(far)), glm::dvec2(far));
  p.field.places[0].noise.lateral_m = 0.0;
  EXPECT_THROW(Deformation(p, viewer), Error);
}

TEST(Deform, ASummitRisesAloneAndSmoothly) {
  DeformParameters p;
  p.summits = {{{5000.0, 5000.0}, 3000.0, 1.5, 1000.0}};
  const auto rise = [&](double from_summit, double z) {
    return Deformation(p, {}).point({5000.0 + from_summit, 5000.0, z}).z - z;
  };
  EXPECT_DOUBLE_EQ(rise(0.0, 2600.0), 0.5 * 1600.0);
  EXPECT_EQ(rise(3000.0, 2600.0), 0.0);
  EXPECT_EQ(rise(9000.0, 2600.0), 0.0);
  EXPECT_EQ(rise(0.0, 1000.0), 0.0);
  EXPECT_EQ(rise(0.0, 400.0), 0.0);
  EXPECT_DOUBLE_EQ(rise(0.0, 1200.0), 100.0);  // from 200 m above the base on in full
  // No step and no kink at the edge, at the centre, at the base and at the end of the blend.
  const double h = 1.0;
  for (const double r : {3000.0, 0.0})
    EXPECT_NEAR((rise(r, 2600.0) - rise(r - h, 2600.0)) / h,
                (rise(r + h, 2600.0) - rise(r, 2600.0)) / h, 1e-3);
  for (const double z : {1000.0, 1200.0})
    EXPECT_NEAR((rise(0.0, z) - rise(0.0, z - h)) / h, (rise(0.0, z + h) - rise(0.0, z)) / h, 0.01);
  // Higher ground stays higher.
  for (double z = 900.0; z < 2600.0; z += 5.0) EXPECT_GT(rise(0.0, z + 5.0) + 5.0, rise(0.0, z));
}

TEST(Deform, SourceIsTheInverseOfHandles) {
  const Deformation deformation(rearranged(), {691234.5, 5302017.25});
  for (const auto [x, y] : test::cells(40, 30)) {
    const glm::dvec2 position = innsbruck.to_crs(x + 0.3, y + 0.1);
    const auto source = deformation.source_of(glm::dvec2(deformation.point({position, 1500.0})));
    ASSERT_TRUE(source);
    ASSERT_LT(glm::length(*source - position), 0.01) << x << ' ' << y;
  }
}

TEST(Deform, LightSeesTheRearrangedShapeWithoutTheBend) {
  DeformParameters p = panorama();
  p.handles = {
      {.centre = {1000.0, 60000.0}, .rotate_deg = 50.0, .radius_m = 4000.0, .core_m = 2000.0}};
  const Deformation deformation(p, {0.0, 0.0});
  // In the core: rotated clockwise by 50°, heights exaggerated 1.6 times, nothing else.
  const glm::dmat3 shape = deformation.shape_jacobian({1500.0, 60500.0, 1800.0});
  const double c = std::cos(to_radians(50.0));
  const double s = std::sin(to_radians(50.0));
  const glm::dmat3 expected(glm::dvec3(c, -s, 0.0), glm::dvec3(s, c, 0.0),
                            glm::dvec3(0.0, 0.0, 1.6));
  for (int column = 0; column < 3; ++column)
    EXPECT_LT(glm::length(shape[column] - expected[column]), 1e-8);
}

TEST(Deform, SameBitsForAnyThreadCount) {
  for (const DeformParameters& p : {panorama(), rearranged()}) {
    const auto vertices = [&] {
      return deform(hills(), innsbruck, {691000.0, 5302000.0}, {691000.0, 5302000.0, 0.0}, p)
          .vertices_m;
    };
    const auto many = vertices();
    const ThreadLimit one(1);
    EXPECT_EQ(vertices(), many);
  }
}

void expect_round_trip(const DeformParameters& parameters, double tolerance_m) {
  const glm::dvec2 viewer(600000.0, 5200000.0);
  const Deformation deformation(parameters, viewer);
  for (const glm::dvec2 step :
       {glm::dvec2(100.0, 0.0), {5000.0, 9000.0}, {-20000.0, 31000.0}, {400.0, 80000.0}})
    for (const double altitude : {-50.0, 600.0, 1500.0, 3900.0}) {
      const glm::dvec3 position(viewer + step, altitude);
      const auto back = undeform(deformation, deformation.point(position));
      ASSERT_TRUE(back.has_value());
      EXPECT_LT(glm::length(*back - position), tolerance_m) << step.x << " " << altitude;
    }
}

TEST(Undeform, BendAndExaggerationGoBackExactly) {
  DeformParameters p;
  expect_round_trip(p, 1e-9);
  p.exaggeration = 1.6;
  p.exaggeration_base_m = 500.0;
  p.bend = {140000.0, 40000.0, 50000.0, 6e-6};
  p.earth_curvature = true;
  expect_round_trip(p, 1e-6);
  p.background_exaggeration = 2.4;
  expect_round_trip(p, 1e-6);
}

TEST(Undeform, SummitsHandlesAndAFieldGoBackWithinMillimetres) {
  DeformParameters p;
  p.exaggeration = 1.5;
  p.bend = {120000.0, 30000.0};
  p.summits = {{{605500.0, 5209500.0}, 6000.0, 1.7, 900.0},
               {{600000.0, 5200500.0}, 3000.0, 0.6, 100.0}};
  expect_round_trip(p, 0.01);
  const DeformHandle handle{.centre = {604000.0, 5208000.0},
                            .move_m = {900.0, -400.0},
                            .raise_m = 250.0,
                            .radius_m = 12000.0,
                            .core_m = 3000.0};
  p.handles = {handle};
  expect_round_trip(p, 0.01);
  p.exaggeration_points = {{5000.0, 1.1}, {60000.0, 0.9}};
  p.field.places = {{{605000.0, 5209000.0}, {250.0, -80.0}, {20.0, 20.0}},
                    {{596000.0, 5212000.0}, {-10.0, 5.0}, {20.0, 20.0}}};
  expect_round_trip(p, 0.01);
}

// 200 × 200 cells of 100 m, its centre at (10000, 10000).
const GeoTransform frame{0.0, 20000.0, 100.0, 100.0};
const Grid<float> flat(200, 200, 500.F);

Deformation with(std::vector<DeformHandle> handles) {
  DeformParameters parameters;
  parameters.handles = std::move(handles);
  parameters.bend.radius_m = 50000.0;
  return {parameters, {10000.0, -20000.0}};
}

std::size_t folds_of(glm::dvec2 move_m, double rotate_deg, double radius_m) {
  return find_folds(flat, frame,
                    with({{.centre = {10000.0, 10000.0},
                           .move_m = move_m,
                           .rotate_deg = rotate_deg,
                           .radius_m = radius_m,
                           .core_m = 3000.0}}))
      .size();
}

TEST(Fold, NoneWithoutHandlesAndNoneWhereATurnIsWideEnough) {
  EXPECT_TRUE(find_folds(flat, frame, with({})).empty());
  EXPECT_EQ(folds_of({}, 50.0, 8000.0), 0U);
  EXPECT_EQ(folds_of({}, 90.0, 9000.0), 0U);
}

TEST(Fold, ATurnFoldsNothingAndAMoveFromItsLimitOn) {
  // A twist preserves areas (until it exceeds the facets). A move folds where the share falls
  // faster than 1 / its length: steepest 15/8 over the ring.
  EXPECT_EQ(folds_of({}, 110.0, 8000.0), 0U);
  EXPECT_EQ(folds_of({0.97 * 4000.0 * 8.0 / 15.0, 0.0}, 0.0, 7000.0), 0U);
  EXPECT_GT(folds_of({1.03 * 4000.0 * 8.0 / 15.0, 0.0}, 0.0, 7000.0), 0U);
}

TEST(Fold, IsFoundWhereAMovedCoreRunsOverTheGroundBeforeIt) {
  // 3 km east, over a ring of 2 km: the ground folds east of the core; on the west it is stretched.
  const std::vector<DeformHandle> handles = {
      {.centre = {4000.0, 4000.0}, .move_m = {300.0, 0.0}, .radius_m = 3500.0, .core_m = 1000.0},
      {.centre = {12000.0, 12000.0},
       .move_m = {3000.0, 0.0},
       .radius_m = 4000.0,
       .core_m = 2000.0}};
  const Deformation deformation = with(handles);
  const std::vector<Fold> folds = find_folds(flat, frame, deformation);
  ASSERT_FALSE(folds.empty());
  for (const Fold& fold : folds) {
    EXPECT_GT(fold.position.x, 12500.0);
    EXPECT_GT(glm::length(fold.position - handles[1].centre), 2000.0 - 142.0);
    EXPECT_LT(glm::length(fold.position - handles[1].centre), 4000.0);
    const glm::dvec2 post = frame.to_crs(fold.column, fold.row);
    EXPECT_LT(glm::length(post - fold.position), 142.0);
  }
  const std::vector<FoldSummary> summary = summarize_folds(folds, deformation.parameters());
  ASSERT_EQ(summary.size(), 1U);
  EXPECT_EQ(summary[0].handle, 1U);
  EXPECT_EQ(summary[0].facets, folds.size());
  EXPECT_NEAR(summary[0].centre.y, 12000.0, 300.0);
  EXPECT_GT(summary[0].centre.x, 14000.0);
  EXPECT_LT(summary[0].centre.x, 16000.0);
}

TEST(Fold, OfAFieldWhoseNeighboursMoveUnlike) {
  DeformParameters parameters;
  parameters.field = {
      .length_m = 1500.0, .reach_m = 800.0, .still_m = 20.0, .max_m = 1500.0, .places = {}};
  // Seen from the south, ground in the west moves to the east and the other way round.
  parameters.field.places = {{{9000.0, 12000.0}, {900.0, 0.0}, {5.0, 5.0}},
                             {{11000.0, 12000.0}, {-900.0, 0.0}, {5.0, 5.0}}};
  const Deformation deformation(parameters, {10000.0, -20000.0});
  const std::vector<Fold> folds = find_folds(flat, frame, deformation);
  ASSERT_FALSE(folds.empty());
  for (const Fold& fold : folds) EXPECT_NEAR(fold.position.x, 10000.0, 1100.0);
  const std::vector<FoldSummary> summary = summarize_folds(folds, parameters);
  ASSERT_EQ(summary.size(), 1U);
  EXPECT_FALSE(summary[0].handle);
  parameters.field.places[1].moved.lateral_m = 600.0;
  EXPECT_TRUE(find_folds(flat, frame, Deformation(parameters, {10000.0, -20000.0})).empty());
}

TEST(Fold, AgreesWithTheSignOfAreasAllOverTheGrid) {
  const Deformation deformation = with({{.centre = {9000.0, 11000.0},
                                         .move_m = {-900.0, 2400.0},
                                         .rotate_deg = 120.0,
                                         .radius_m = 4000.0,
                                         .core_m = 1500.0}});
  std::size_t turned_over = 0;
  const auto position = [&](int x, int y) {
    return glm::dvec2(deformation.point({frame.to_crs(x, y), 500.0}));
  };
  const auto area = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  for (const auto [x, y] : test::cells(199, 199)) {
    turned_over += area(position(x, y), position(x, y + 1), position(x + 1, y)) <= 0.0 ? 1 : 0;
    turned_over +=
        area(position(x + 1, y + 1), position(x + 1, y), position(x, y + 1)) <= 0.0 ? 1 : 0;
  }
  EXPECT_GT(turned_over, 10U);
  EXPECT_EQ(find_folds(flat, frame, deformation).size(), turned_over);
}

TEST(Fold, SameForAnyThreadCount) {
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<std::pair<int, int>> cells;
    for (const Fold& fold :
         find_folds(flat, frame,
                    with({{.centre = {9e3, 9e3}, .move_m = {4000.0, 0.0}, .radius_m = 4500.0}})))
      cells.emplace_back(fold.column, fold.row);
    return cells;
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace belvedere
