#include "terrain/deform/undeform.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace belvedere {
namespace {

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
  DeformHandle handle;
  handle.centre = {604000.0, 5208000.0};
  handle.radius_m = 12000.0;
  handle.core_m = 3000.0;
  handle.move_m = {900.0, -400.0};
  handle.raise_m = 250.0;
  p.handles = {handle};
  expect_round_trip(p, 0.01);
  p.exaggeration_points = {{5000.0, 1.1}, {60000.0, 0.9}};
  p.field.places = {{{605000.0, 5209000.0}, {250.0, -80.0}, {20.0, 20.0}},
                    {{596000.0, 5212000.0}, {-10.0, 5.0}, {20.0, 20.0}}};
  expect_round_trip(p, 0.01);
}

}  // namespace
}  // namespace belvedere
