#include "renderer/features/drawn_houses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/renderer/features/rectangle.h"
#include "tests/renderer/features/test_ground.h"

namespace belvedere {
namespace {

using test::rectangle;
using test::set_of;
using test::TestGround;

FeatureStyle house_style(const std::string& more = "") {
  return parse_feature_style(
      "version = 1\n[kinds.house]\ndraw = \"building\"\nshrink = 0\nmin_px = 0\nwidth_mm = "
      "0.01\n" +
          more,
      "test.toml");
}

Feature house(std::vector<glm::dvec2> outline) {
  Feature feature;
  feature.shape = outline.size() == 1 ? MapShape::point : MapShape::area;
  feature.parts = {std::move(outline)};
  feature.width_mm = 0.01F;
  return feature;
}

DrawnFeatures draw_house(const TestGround& ground, std::vector<glm::dvec2> outline,
                         glm::dvec3 sun = {0.6, 0.0, 0.8}) {
  return draw_features(set_of(house_style(), {house(std::move(outline))}), ground.sight(),
                       {.px_per_mm = 20.0, .sun = sun});
}

TEST(DrawnHouses, StandOnTheirPlaceInTheirSize) {
  const TestGround ground([](glm::dvec2) { return 0.0; }, {0.0, -300.0, 150.0}, 800, 600);
  const DrawnFeatures drawn = draw_house(ground, rectangle({0.0, 0.0}, 60.0, 20.0, 0.0));
  ASSERT_EQ(drawn.houses.size(), 1U);
  const DrawnHouse& one = drawn.houses[0];
  EXPECT_LT(glm::length(glm::dvec2(one.foot) - ground.pixel({0.0, 0.0, 0.0})), 0.01);
  // The view is less steep than the roof's far side: the southern wall and one side are visible.
  ASSERT_EQ(one.faces.size(), 2U);
  const HouseFace& wall = one.faces[0];
  EXPECT_FALSE(wall.roof);
  const double length =
      glm::length(ground.pixel({30.0, -10.0, 0.0}) - ground.pixel({-30.0, -10.0, 0.0}));
  EXPECT_NEAR(static_cast<double>(glm::length(wall.corners[1] - wall.corners[0])), length,
              0.01 * length);
  EXPECT_TRUE(one.faces[1].roof);
}

TEST(DrawnHouses, TheSunnySideIsLight) {
  const TestGround ground([](glm::dvec2) { return 0.0; }, {0.0, -300.0, 150.0}, 800, 600);
  // The ridge runs north to south, the sun is in the east.
  const DrawnFeatures drawn =
      draw_house(ground, rectangle({0.0, 0.0}, 40.0, 20.0, 1.5707963), {0.8, 0.0, 0.6});
  std::vector<HouseFace> roofs;
  for (const HouseFace& face : drawn.houses.at(0).faces)
    if (face.roof) roofs.push_back(face);
  ASSERT_EQ(roofs.size(), 2U);
  std::sort(roofs.begin(), roofs.end(),
            [](const HouseFace& a, const HouseFace& b) { return a.corners[0].x < b.corners[0].x; });
  EXPECT_GT(roofs[1].light, roofs[0].light + 0.4F) << "the eastern side";
  EXPECT_LT(drawn.houses[0].shades.at(0).to.x, drawn.houses[0].foot.x)
      << "the shadow falls to the west";
}

// An L: two roofs with perpendicular ridges, and the house extends as far as its outline.
TEST(DrawnHouses, WingsHaveRoofsOfTheirOwn) {
  const TestGround ground([](glm::dvec2) { return 0.0; }, {0.0, -300.0, 150.0}, 800, 600);
  const std::vector<glm::dvec2> outline = {{-30, -25}, {30, -25}, {30, -10},
                                           {-15, -10}, {-15, 25}, {-30, 25}};
  const DrawnFeatures drawn = draw_house(ground, outline);
  ASSERT_EQ(drawn.houses.size(), 1U);
  const DrawnHouse& one = drawn.houses[0];
  std::size_t roofs = 0;
  bool across = false;
  bool along = false;
  for (const HouseFace& face : one.faces) {
    if (!face.roof) continue;
    ++roofs;
    const glm::vec2 ridge = glm::abs(face.corners[3] - face.corners[2]);
    (ridge.x > 3.F * ridge.y ? along : across) = true;
  }
  EXPECT_GE(roofs, 3U);
  EXPECT_TRUE(across && along);
  EXPECT_EQ(one.shades.size(), 2U);
  const glm::dvec2 corner = ground.pixel({-30.0, 25.0, 0.0});
  EXPECT_GT(static_cast<double>(one.reach_px), glm::length(corner - glm::dvec2(one.foot)));
  // Nothing stands in the open corner of the L.
  const glm::dvec2 yard = ground.pixel({20.0, 15.0, 0.0});
  for (const HouseFace& face : one.faces) {
    const glm::dvec2 centre = 0.5 * (glm::dvec2(face.corners[0]) + glm::dvec2(face.corners[2]));
    EXPECT_GT(glm::length(centre - yard), 20.0);
  }
}

TEST(DrawnHouses, PointsBecomeHousesAndSmallOnesAreEnlarged) {
  const TestGround ground([](glm::dvec2 p) { return 0.3 * p.x; });
  ASSERT_EQ(draw_house(ground, {{0.0, 0.0}}).houses.size(), 1U);
  FeatureSet large = set_of(house_style("casing_mm = 0\n"), {house({{0.0, 0.0}})});
  large.features[0].width_mm = 2.F;
  const DrawnFeatures enlarged = draw_features(large, ground.sight(), {.px_per_mm = 5.0});
  EXPECT_GT(enlarged.houses.at(0).reach_px, 5.F);
  EXPECT_GT(enlarged.house_reach_px, 5);
}

TEST(DrawnHouses, AreHiddenByMountainsAndCounted) {
  const TestGround ground([](glm::dvec2 p) { return std::abs(p.y) < 100.0 ? 900.0 : 0.0; });
  EXPECT_EQ(draw_house(ground, {{0.0, 600.0}}).counts[0][0].hidden, 1U);
  EXPECT_EQ(draw_house(ground, {{0.0, 6000.0}}).counts[0][0].outside_terrain, 1U);
  EXPECT_EQ(draw_house(ground, {{-1990.0, -1990.0}}).counts[0][0].outside_picture, 1U);
}

}  // namespace
}  // namespace belvedere
