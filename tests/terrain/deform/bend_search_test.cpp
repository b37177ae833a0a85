#include "terrain/deform/bend_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/math.h"
#include "base/parallel.h"
#include "terrain/shape/valley_floor.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// Ridges 1 km high across the view, every 8 km, with flat floors 2 km wide between them; 100 m
// cells, the viewer south of all, looking north.
constexpr int width = 200;
constexpr int height = 600;
const GeoTransform northern_frame{-10000.0, 70000.0, 100.0, 100.0};  // northings 10…70 km
const glm::dvec2 viewer(0.0, 0.0);

float ridge_height(double north) {
  const double phase =
      std::abs(std::remainder(north - 10000.0, 8000.0));  // 0 in the middle of a floor
  return static_cast<float>(500.0 + 1000.0 * std::clamp((phase - 1000.0) / 3000.0, 0.0, 1.0));
}

Grid<float> ridges() {
  return test::grid_of(width, height,
                       [&](int x, int y) { return ridge_height(northern_frame.to_crs(x, y).y); });
}

std::vector<SightLine> northward(int count) {
  std::vector<SightLine> lines;
  for (int i = 0; i < count; ++i) lines.push_back({-4.0 + 8.0 * (i + 0.5) / count, -1e9, 1e9});
  return lines;
}

ValleySight sight(double eye_m, const DeformParameters& p = {}, int lines = 40) {
  return {ridges(), northern_frame, Deformation(p, viewer), eye_m, northward(lines)};
}

TEST(ValleySight, SeesWhatAStraightLineReaches) {
  // From high above everything is visible, from the ground nothing behind the first ridge.
  EXPECT_GT(sight(200000.0).visible_share(BendProfile({})), 0.999);
  EXPECT_LT(sight(600.0).visible_share(BendProfile({})), 0.02);
  // In between, compared with rays marched cell by cell from each floor back to the eye along one
  // meridian.
  const double eye = 9000.0;
  BendCurve curve;
  curve.points = {{10000.0, std::nullopt, 9.0}, {70000.0, std::nullopt, 0.0}};
  const BendProfile bend(curve);
  const Grid<std::uint8_t> floor = find_valley_floor(ridges(), 100.0);
  const auto height_at = [&](double d) {
    return static_cast<double>(ridge_height(d)) - bend.drop_m(d);
  };
  double seen = 0.0;
  double all = 0.0;
  for (int y = 0; y < height; ++y) {
    const double d = northern_frame.to_crs(width / 2, y).y;
    if (floor(width / 2, y) == 0) continue;
    all += d;
    bool visible = true;
    for (double t = 10000.0; t < d - 50.0 && visible; t += 25.0)
      visible = height_at(t) <= eye + (height_at(d) - eye) * t / d + 1e-6;
    seen += visible ? d : 0.0;
  }
  EXPECT_GT(seen / all, 0.2);
  EXPECT_LT(seen / all, 0.9);
  EXPECT_NEAR(sight(eye).visible_share(bend), seen / all, 0.03);
}

TEST(ValleySight, OnlyWhatThePictureShowsCounts) {
  std::vector<SightLine> lines = northward(40);
  const ValleySight whole(ridges(), northern_frame, Deformation({}, viewer), 30000.0, lines);
  for (SightLine& line : lines) line.highest = (500.0 - 30000.0) / 40000.0;  // nothing beyond 40 km
  const ValleySight part(ridges(), northern_frame, Deformation({}, viewer), 30000.0, lines);
  const double all = whole.visible_share(BendProfile({}));
  const double near = part.visible_share(BendProfile({}));
  EXPECT_GT(all, 0.9);
  EXPECT_NEAR(near / all, (40.0 * 40.0 - 100.0) / (70.0 * 70.0 - 100.0), 0.08);
  // Area of the floors: eight sectors of 8°.
  double area = 0.0;
  for (double d = 10000.0; d < 70000.0; d += 10.0)
    if (std::abs(std::remainder(d - 10000.0, 8000.0)) < 1000.0)
      area += to_radians(8.0) * d * 10.0 * 1e-6;
  EXPECT_NEAR(whole.floor_km2(), area, 0.12 * area);
}

TEST(BendSearch, ShowsMoreWithinItsBoundsThanAnyConstantTilt) {
  const ValleySight ground = sight(9000.0);
  const BendSearchParameters bounds{
      .max_inclination_deg = 12.0, .max_bending_deg_per_10km = 8.0, .points = 4};
  const BendFound found = search_bend(ground, bounds, silent_progress());
  EXPECT_LE(found.distortion.largest_deg, 12.0 + 1e-9);
  EXPECT_LE(found.distortion.bending_deg_per_10km, 8.0 * 1.001);
  EXPECT_EQ(*found.curve.points.back().inclination_deg, 0.0);
  for (std::size_t i = 1; i < found.curve.points.size(); ++i)
    EXPECT_LE(*found.curve.points[i].inclination_deg, *found.curve.points[i - 1].inclination_deg);
  const double unbent = ground.visible_share(BendProfile({}));
  EXPECT_GT(found.visible_share, unbent + 0.1);
  EXPECT_NEAR(found.visible_share, ground.visible_share(BendProfile(found.curve)), 1e-12);
  // No parabola within the same bounds shows more by the price of a few degrees.
  for (double tilt = 1.0; tilt <= 12.0; tilt += 1.0) {
    BendCurve parabola;
    parabola.points = {{ground.nearest_m(), std::nullopt, tilt},
                       {ground.farthest_m(), std::nullopt, 0.0}};
    if (measure_distortion(BendProfile(parabola), ground.nearest_m(), ground.farthest_m())
            .bending_deg_per_10km > 8.0)
      continue;
    EXPECT_GE(found.visible_share, ground.visible_share(BendProfile(parabola)) - 0.01) << tilt;
  }
  // A tighter bound shows less.
  BendSearchParameters tight = bounds;
  tight.max_inclination_deg = 3.0;
  EXPECT_LT(search_bend(ground, tight, silent_progress()).visible_share, found.visible_share);
}

TEST(BendSearch, SameForAnyThreadCountAndRefusesWhatIsOutOfRange) {
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    const BendFound found = search_bend(sight(9000.0, {}, 16), {.points = 3}, silent_progress());
    std::vector<double> values = {found.visible_share};
    for (const BendPoint& point : found.curve.points) values.push_back(*point.inclination_deg);
    return values;
  };
  EXPECT_EQ(run(1), run(2));
  EXPECT_THROW(search_bend(sight(9000.0), {.max_inclination_deg = 80.0}, silent_progress()), Error);
  const ValleySight plain(Grid<float>(100, 100, 500.F), {-5000.0, 20000.0, 100.0, 100.0},
                          Deformation({}, viewer), 9000.0, northward(4));
  EXPECT_THROW(search_bend(plain, {}, silent_progress()), Error);
}

TEST(BendSearch, DistortionOfAParabola) {
  const BendDistortion d =
      measure_distortion(BendProfile(BendCurve{100000.0, 60000.0, 0.0, 0.0, {}}), 10000.0, 80000.0);
  EXPECT_NEAR(d.largest_deg, to_degrees(std::atan(0.5)), 1e-6);
  EXPECT_NEAR(d.bending_deg_per_10km, to_degrees(0.1), 0.01);  // greatest where it is level
}

}  // namespace
}  // namespace belvedere
