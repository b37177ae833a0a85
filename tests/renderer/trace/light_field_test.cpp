#include "renderer/trace/light_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/math_exact.h"
#include "base/random.h"

namespace belvedere {
namespace {

const glm::dvec3 north_west = glm::normalize(glm::dvec3(-0.6, 0.6, 0.5));
const glm::dvec3 south_east = glm::normalize(glm::dvec3(0.5, -0.7, 0.4));
const glm::dvec2 right{-1.0, 0.0};  // of a view to the south

LightField with_regions(std::vector<LightRegion> regions) {
  return {north_west, right, std::move(regions), {}, 1};
}
LightField with_cloud(const CloudShadow& cloud, std::uint64_t seed = 1) {
  return {north_west, right, {}, {cloud}, seed};
}

TEST(LightField, ARegionHoldsInsideAndFadesOverItsBlend) {
  const LightRegion region{.centre = {1000.0, 2000.0}, .radius_m = 500.0, .blend_m = 400.0};
  const auto weight = [&](double from_centre) {
    return LightField::weight(region, {1000.0 + from_centre, 2000.0});
  };
  EXPECT_EQ(weight(0.0), 1.0);
  EXPECT_EQ(weight(500.0), 1.0);
  EXPECT_NEAR(weight(600.0), 1.0 - 5.0 / 32.0, 1e-12);  // 3t² - 2t³ at a quarter
  EXPECT_NEAR(weight(700.0), 0.5, 1e-12);
  EXPECT_EQ(weight(900.0), 0.0);
  LightRegion hard = region;
  hard.blend_m = 0.0;
  EXPECT_EQ(LightField::weight(hard, {1500.0, 2000.0}), 1.0);
  EXPECT_EQ(LightField::weight(hard, {1500.1, 2000.0}), 0.0);
}

TEST(LightField, AnOutlineHasHolesAndCorners) {
  const LightRegion region{.rings = {{{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}},
                                     {{400, 400}, {600, 400}, {600, 600}, {400, 600}}},
                           .blend_m = 200.0};
  EXPECT_EQ(LightField::weight(region, {200.0, 500.0}), 1.0);
  EXPECT_NEAR(LightField::weight(region, {500.0, 500.0}), 0.5,
              1e-12);  // in the centre of the hole, 100 m from its edge
  EXPECT_NEAR(LightField::weight(region, {1100.0, 500.0}), 0.5, 1e-12);
  EXPECT_NEAR(LightField::weight(region, {1060.0, 1080.0}), 0.5, 1e-12);  // 100 m from the corner
  EXPECT_EQ(LightField::weight(region, {1150.0, 1150.0}), 0.0);
}

// The weighted sum of unit vectors, normalized; the other values linear.
TEST(LightField, BlendsByWeight) {
  const LightRegion region{.centre = {0.0, 0.0},
                           .radius_m = 500.0,
                           .blend_m = 400.0,
                           .sun_direction = south_east,
                           .strength = 1.4,
                           .warmth = 0.8};
  const LightField field = with_regions({region});
  for (const double x : {0.0, 520.0, 640.0, 700.0, 830.0}) {
    const double share = LightField::weight(region, {x, 0.0});
    const GroundLight light = field.at({x, 0.0});
    EXPECT_LT(
        glm::length(light.sun - glm::normalize(north_west * (1.0 - share) + south_east * share)),
        1e-12)
        << x;
    EXPECT_NEAR(light.strength, 1.0 + 0.4 * share, 1e-6) << x;
    EXPECT_NEAR(light.warmth, 0.8 * share, 1e-6) << x;
    EXPECT_NEAR(light.side, 1.0 - 2.0 * share, 1e-6)
        << x;  // a view to the south has the north-west on its right
  }
  const GroundLight outside = field.at({901.0, 0.0});
  EXPECT_EQ(outside.sun, north_west) << "bit for bit";
  EXPECT_EQ(outside.strength, 1.0F);
  EXPECT_EQ(outside.warmth, 0.0F);
  EXPECT_EQ(outside.side, 1.0F);
}

TEST(LightField, LaterRegionsLieOverEarlierOnes) {
  const LightRegion below{.radius_m = 1000.0, .sun_direction = south_east, .strength = 0.5};
  const LightRegion above{
      .radius_m = 300.0, .blend_m = 0.0, .sun_direction = {0.0, 0.0, 1.0}, .strength = 1.5};
  EXPECT_EQ(with_regions({below, above}).at({0.0, 0.0}).strength, 1.5F);
  EXPECT_EQ(with_regions({above, below}).at({0.0, 0.0}).strength, 0.5F);
}

// With everything rotated about the vertical axis, the light is the same, rotated: no direction of
// the map is special.
TEST(LightField, TurnsWithTheMap) {
  const exact::Turn by = exact::turn(0.7);
  const auto turn2 = [&](glm::dvec2 v) {
    return glm::dvec2(v.x * by.cosine - v.y * by.sine, v.x * by.sine + v.y * by.cosine);
  };
  const auto turn3 = [&](glm::dvec3 v) { return glm::dvec3(turn2(glm::dvec2(v)), v.z); };
  LightRegion circle{.centre = {800.0, 300.0},
                     .radius_m = 400.0,
                     .blend_m = 600.0,
                     .sun_direction = south_east,
                     .strength = 1.3,
                     .warmth = -0.4};
  LightRegion outline{.rings = {{{-500, -200}, {300, -350}, {100, 500}}},
                      .blend_m = 350.0,
                      .sun_direction = {0.0, 0.0, 1.0},
                      .strength = 0.8};
  const LightField field(north_west, right, {circle, outline}, {}, 1);
  circle.centre = turn2(circle.centre);
  circle.sun_direction = turn3(circle.sun_direction);
  for (glm::dvec2& corner : outline.rings.front()) corner = turn2(corner);
  const LightField turned(turn3(north_west), turn2(right), {circle, outline}, {}, 1);
  for (int k = 0; k < 400; ++k) {
    const glm::dvec2 position{3000.0 * random_uniform(7, k, 0) - 1500.0,
                              3000.0 * random_uniform(7, k, 1) - 1500.0};
    const GroundLight here = field.at(position);
    const GroundLight there = turned.at(turn2(position));
    EXPECT_LT(glm::length(turn3(here.sun) - there.sun), 1e-9);
    EXPECT_NEAR(here.strength, there.strength, 1e-5);
    EXPECT_NEAR(here.warmth, there.warmth, 1e-5);
    EXPECT_NEAR(here.side, there.side, 1e-5);
    EXPECT_NEAR(glm::length(here.sun), 1.0, 1e-12);
  }
}

TEST(LightField, ACloudTakesItsShareInTheMiddleAndNothingBeyond) {
  const CloudShadow cloud{
      .centre = {5000.0, 5000.0}, .radius_m = 2000.0, .strength = 0.8, .blend_m = 1000.0};
  const LightField field = with_cloud(cloud);
  const float centre = field.at(cloud.centre).strength;
  EXPECT_GE(centre, 0.2F);
  EXPECT_LE(centre, 0.2F + 0.8F * 0.12F + 1e-6F);
  // Noise moves the edge by at most .72 of the radius.
  for (int k = 0; k < 64; ++k) {
    const exact::Turn way = exact::turn(0.1 * k);
    const glm::dvec2 out =
        cloud.centre + (2000.0 * 1.72 + 501.0) * glm::dvec2(way.cosine, way.sine);
    EXPECT_EQ(field.at(out).strength, 1.0F);
    EXPECT_LT(field.at(cloud.centre + (2000.0 * 0.28 - 501.0) * glm::dvec2(way.cosine, way.sine))
                  .strength,
              0.3F);
  }
  EXPECT_FALSE(field.turns_sun());
  EXPECT_EQ(field.at(cloud.centre).sun, north_west);
}

// Soft: over the whole edge the strength changes by no more than blend and lobes allow; lobed: the
// edge varies in distance.
TEST(LightField, ACloudIsSoftAndLobed) {
  const CloudShadow cloud{
      .centre = {0.0, 0.0}, .radius_m = 2000.0, .strength = 1.0, .blend_m = 1200.0};
  const LightField field = with_cloud(cloud);
  double nearest = 1e9;
  double farthest = 0.0;
  for (int k = 0; k < 90; ++k) {
    const exact::Turn way = exact::turn(0.0698 * k);
    float before = field.at({0.0, 0.0}).strength;
    double edge = 0.0;
    for (double r = 25.0; r < 5000.0; r += 25.0) {
      const float here = field.at(r * glm::dvec2(way.cosine, way.sine)).strength;
      EXPECT_LT(std::abs(here - before), 0.12F);
      if (before < 0.5F && here >= 0.5F) edge = r;
      before = here;
    }
    nearest = std::min(nearest, edge);
    farthest = std::max(farthest, edge);
  }
  EXPECT_GT(farthest - nearest, 600.0);
  // Another seed or another position gives another cloud.
  EXPECT_NE(field.at({1800.0, 300.0}).strength, with_cloud(cloud, 2).at({1800.0, 300.0}).strength);
}

TEST(LightField, RefusesSunsBelowTheHorizon) {
  EXPECT_THROW(with_regions({{.radius_m = 1.0, .sun_direction = {1.0, 0.0, 0.0}}}), Error);
  EXPECT_THROW(LightField({1.0, 0.0, -0.1}, right, {}, {}, 1), Error);
}

}  // namespace
}  // namespace belvedere
