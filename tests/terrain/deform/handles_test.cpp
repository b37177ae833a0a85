#include "terrain/deform/handles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "base/error.h"
#include "base/math.h"

namespace belvedere {
namespace {

const glm::dvec2 centre(690000.0, 5250000.0);

// Clockwise seen from above, as compass directions.
glm::dvec2 turned(glm::dvec2 v, double deg) {
  const double c = std::cos(to_radians(deg));
  const double s = std::sin(to_radians(deg));
  return {v.x * c + v.y * s, -v.x * s + v.y * c};
}

DeformHandle turn_50() {
  return {.centre = centre, .rotate_deg = 50.0, .radius_m = 8000.0, .core_m = 3000.0};
}

template <class F>
void around(double from_m, double to_m, F&& f) {
  for (int ring = 0; ring <= 8; ++ring)
    for (int spoke = 0; spoke < 24; ++spoke)
      f(centre + turned({0.0, from_m + (to_m - from_m) * ring / 8}, 15.0 * spoke));
}

TEST(Handles, WithoutAnyOrWithStillOnesEveryPlaceStays) {
  for (const HandleField& field :
       {HandleField(), HandleField({{.centre = centre, .radius_m = 5000.0, .core_m = 100.0},
                                    {.centre = centre + 9e3, .radius_m = 0.0}})}) {
    EXPECT_TRUE(field.is_identity());
    around(0.0, 9000.0, [&](glm::dvec2 v) {
      EXPECT_EQ(field.move(v).position, v);
      EXPECT_EQ(field.move(v).raise_m, 0.0);
    });
  }
}

TEST(Handles, ATurnIsExactInItsCoreAndNothingOutsideItsRadius) {
  DeformHandle handle = turn_50();
  handle.move_m = {700.0, -300.0};
  handle.scale = 1.2;
  handle.raise_m = 150.0;
  const HandleField field({handle});
  around(0.0, 3000.0, [&](glm::dvec2 v) {
    const HandleField::Moved moved = field.move(v);
    EXPECT_LT(
        glm::length(moved.position - (centre + handle.move_m + 1.2 * turned(v - centre, 50.0))),
        1e-8);
    EXPECT_EQ(moved.raise_m, 150.0);
  });
  // North of the centre goes to azimuth 50°: clockwise.
  EXPECT_GT(field.move(centre + glm::dvec2(0.0, 1000.0)).position.x,
            centre.x + handle.move_m.x + 900.0);
  around(8000.0, 30000.0, [&](glm::dvec2 v) {
    if (glm::length(v - centre) < 8000.0) return;  // rounding of the circle
    EXPECT_EQ(field.move(v).position, v);
    EXPECT_EQ(field.move(v).raise_m, 0.0);
  });
  // In between, it has an effect.
  EXPECT_GT(glm::length(field.move(centre + glm::dvec2(5000.0, 0.0)).position - centre -
                        glm::dvec2(5000.0, 0.0)),
            100.0);
}

TEST(Handles, BetweenCoreAndRadiusATurnFadesAndKeepsDistances) {
  const HandleField field({turn_50()});
  double before = 50.0;
  for (double d = 3000.0; d <= 8000.0; d += 100.0) {
    const glm::dvec2 moved = field.move(centre + glm::dvec2(0.0, d)).position - centre;
    EXPECT_NEAR(glm::length(moved), d, 1e-6);
    const double angle = to_degrees(std::atan2(moved.x, moved.y));
    EXPECT_LE(angle, before + 1e-9);
    EXPECT_GE(angle, -1e-9);
    before = angle;
  }
  // Half way the two rotations have equal weights.
  EXPECT_NEAR(
      to_degrees(std::atan2(field.move(centre + glm::dvec2(0.0, 5500.0)).position.x - centre.x,
                            field.move(centre + glm::dvec2(0.0, 5500.0)).position.y - centre.y)),
      25.0, 1e-9);
}

TEST(Handles, EdgesHaveNoStepAndNoKink) {
  DeformHandle handle = turn_50();
  handle.move_m = {700.0, -300.0};
  handle.raise_m = 150.0;
  // Another one whose radius overlaps the first: its own edges must be smooth there, too.
  const DeformHandle other{.centre = centre + glm::dvec2(9000.0, 1000.0),
                           .move_m = {0.0, 900.0},
                           .radius_m = 5000.0,
                           .core_m = 1500.0};
  const HandleField field({handle, other});
  const auto check = [&](glm::dvec2 centre, double radius) {
    for (int spoke = 0; spoke < 36; ++spoke) {
      const glm::dvec2 out = turned({0.0, 1.0}, 10.0 * spoke);
      const glm::dvec2 edge = centre + radius * out;
      const auto slope = [&](double from, double to) {
        const auto a = field.move(edge + from * out);
        const auto b = field.move(edge + to * out);
        return glm::dvec3(b.position - a.position, b.raise_m - a.raise_m) / (to - from);
      };
      EXPECT_LT(glm::length(slope(-1e-4, 1e-4)), 3.0);  // no step: that would be thousands
      // Second derivatives stay below 1/100 m here, so slopes a metre apart agree unless there is a
      // kink.
      EXPECT_LT(glm::length(slope(-1.0, -1e-3) - slope(1e-3, 1.0)), 0.01) << spoke;
    }
  };
  check(centre, 3000.0);
  check(centre, 8000.0);
  check(other.centre, 1500.0);
  check(other.centre, 5000.0);
}

TEST(Handles, HandlesWithoutRadiusThatAgreeTurnThePlane) {
  // Two rigid ones, and three pins: each set means "rotate by 30° about a distant point".
  const glm::dvec2 pivot = centre + glm::dvec2(-4000.0, 2500.0);
  const auto image = [&](glm::dvec2 v) { return pivot + turned(v - pivot, 30.0); };
  const auto at = [&](glm::dvec2 centre, bool pin) {
    return DeformHandle{.centre = centre,
                        .move_m = image(centre) - centre,
                        .rotate_deg = 30.0,
                        .core_m = pin ? 0.0 : 400.0,
                        .pin = pin};
  };
  const glm::dvec2 a = centre;
  const glm::dvec2 b = centre + glm::dvec2(6000.0, 0.0);
  const glm::dvec2 c = centre + glm::dvec2(1000.0, 5000.0);
  for (const HandleField& field :
       {HandleField({at(a, false), at(b, false)}),
        HandleField({at(a, true), at(b, true), at(c, true)}),
        HandleField({at(a, true), at(b, true)}), HandleField({at(a, false)})}) {
    around(0.0, 40000.0,
           [&](glm::dvec2 v) { EXPECT_LT(glm::length(field.move(v).position - image(v)), 1e-6); });
  }
}

TEST(Handles, ACoreWithoutRadiusIsExactBesideAnother) {
  const HandleField field(
      {{.centre = centre, .rotate_deg = 40.0, .core_m = 2000.0},
       {.centre = centre + glm::dvec2(9000.0, 0.0), .move_m = {300.0, 500.0}, .core_m = 1000.0}});
  around(0.0, 2000.0, [&](glm::dvec2 v) {
    EXPECT_LT(glm::length(field.move(v).position - centre - turned(v - centre, 40.0)), 1e-8);
  });
}

TEST(Handles, CentresAreInterpolatedExactly) {
  std::vector<DeformHandle> handles;
  for (int i = 0; i < 20; ++i)  // more than fit on the stack
    handles.push_back({.centre = centre + turned({0.0, 4000.0}, 18.0 * i),
                       .move_m = turned({200.0, 50.0 * i}, 40.0 * i),
                       .rotate_deg = 3.0 * i,
                       .raise_m = 10.0 * i,
                       .radius_m = i % 3 == 0 ? 0.0 : 6000.0,
                       .core_m = 0.0,
                       .pin = i % 2 == 0});
  const HandleField field(handles);
  for (const DeformHandle& handle : handles) {
    EXPECT_LT(glm::length(field.move(handle.centre).position - handle.centre - handle.move_m),
              1e-6);
    EXPECT_NEAR(field.move(handle.centre).raise_m, handle.raise_m, 1e-9);
    // And nearly so a millimetre away.
    EXPECT_LT(
        glm::length(field.move(handle.centre + 0.001).position - handle.centre - handle.move_m),
        0.02);
  }
}

TEST(Handles, APinOfLimitedReachMovesItsSurroundings) {
  const HandleField field({{.centre = centre,
                            .move_m = {500.0, 0.0},
                            .rotate_deg = 90.0,
                            .radius_m = 4000.0,
                            .pin = true}});
  EXPECT_LT(glm::length(field.move(centre).position - centre - glm::dvec2(500.0, 0.0)), 1e-9);
  const glm::dvec2 near = centre + glm::dvec2(0.0, 300.0);
  EXPECT_LT(glm::length(field.move(near).position - near - glm::dvec2(500.0, 0.0)),
            60.0);  // its rotation does not count
  EXPECT_EQ(field.move(centre + glm::dvec2(0.0, 4000.0)).position,
            centre + glm::dvec2(0.0, 4000.0));
}

TEST(Handles, RefusesCoresThatOverlapOrFillTheirRadius) {
  const auto refused = [](std::vector<DeformHandle> handles) {
    try {
      const HandleField field(std::move(handles));
      return false;
    } catch (const Error& error) {
      return error.kind() == ErrorKind::usage;
    }
  };
  DeformHandle wide = turn_50();
  wide.core_m = 8000.0;
  EXPECT_TRUE(refused({wide}));
  DeformHandle near = turn_50();
  near.centre.x += 5000.0;
  EXPECT_TRUE(refused({turn_50(), near}));
  near.centre.x += 1001.0;
  EXPECT_FALSE(refused({turn_50(), near}));
  near.move_m.x = NAN;
  EXPECT_TRUE(refused({near}));
}

}  // namespace
}  // namespace belvedere
