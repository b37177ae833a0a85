#include "texture/strokes/ice/ice_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"
#include "texture/strokes/ice/ice_ground.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr int width_units = 300;
constexpr int height_units = 420;

// Ice that falls to the lower right, a rib of rock in it, steep snow on the left; 8 km away.
Picture valley(double pixels_per_unit) {
  const auto width = static_cast<int>(width_units * pixels_per_unit);
  const auto height = static_cast<int>(height_units * pixels_per_unit);
  Picture p = plain_picture(glacier, width, height);
  p.parameters.pixels_per_unit = pixels_per_unit;
  p.guidance.depth_m = Grid<float>(width, height, 8000.F);
  p.guidance.fall_line = Grid<glm::vec2>(width, height, glm::vec2(0.28F, 0.96F));
  p.guidance.relief_s_m = Grid<float>(width, height, 25.F);
  for (const auto [x, y] : test::cells(width, height)) {
    const double u = x / pixels_per_unit;
    const double v = y / pixels_per_unit;
    if (u < 100.0) p.guidance.land_cover(x, y) = snow;
    if (u >= 150.0 && u < 166.0 && v < 120.0) p.guidance.land_cover(x, y) = rock;
    p.guidance.slope_deg(x, y) = u < 100.0 ? 42.F : 14.F;
  }
  return p;
}

std::vector<IceWay> ways_of(const IcePlan& plan, Stream stream) {
  std::vector<IceWay> ways;
  std::copy_if(plan.ways.begin(), plan.ways.end(), std::back_inserter(ways),
               [&](const IceWay& way) { return way.stream == stream; });
  return ways;
}

TEST(IcePlan, OfGroundWithoutIceIsEmpty) {
  const Picture p = plain_picture(rock, 40, 30);
  const IcePlan plan = plan_ice(p.guidance, p.parameters);
  EXPECT_TRUE(plan.ways.empty());
  EXPECT_EQ(plan.flow.at({20.F, 10.F}), glm::vec2(0.F, 1.F));
}

TEST(IcePlan, WaysStayOnTheirGroundAndLieDownTheFlow) {
  const Picture p = valley(1.0);
  const IcePlan plan = plan_ice(p.guidance, p.parameters);
  for (const Stream stream :
       {Stream::glacier_flow_lines, Stream::glacier_moraines, Stream::glacier_crevasses}) {
    const std::vector<IceWay> ways = ways_of(plan, stream);
    EXPECT_FALSE(ways.empty()) << static_cast<int>(stream);
    for (const IceWay& way : ways) {
      ASSERT_EQ(way.positions.size(), way.depth_m.size());
      for (const glm::vec2 at : way.positions) {
        EXPECT_EQ(p.guidance.land_cover(static_cast<int>(at.x), static_cast<int>(at.y)),
                  way.land_cover);
        EXPECT_TRUE(at.x >= way.lowest.x && at.y >= way.lowest.y && at.x <= way.highest.x &&
                    at.y <= way.highest.y);
      }
      EXPECT_EQ(way.land_cover, glacier);
      if (stream == Stream::glacier_crevasses) continue;
      for (std::size_t k = 1; k < way.positions.size(); ++k)
        EXPECT_LT(angle_deg(way.positions[k] - way.positions[k - 1], {0.28F, 0.96F}), 1.0);
    }
  }
  float longest = 0.F;
  for (const IceWay& way : ways_of(plan, Stream::glacier_moraines))
    longest = std::max(longest, way.highest.y - way.lowest.y);
  EXPECT_GT(longest, 90.F) << "longer than any kind of stroke looks";
}

// A glacier between bare slopes has more crevasses and flow lines than firn surrounded by snow.
TEST(IcePlan, TonguesAreTornAndFirnIsWhole) {
  const auto count = [](LandCoverClass beside, Stream stream) {
    Picture p = plain_picture(glacier, 420, 420);
    p.guidance.depth_m = Grid<float>(420, 420, 8000.F);
    p.guidance.slope_deg = Grid<float>(420, 420, 20.F);
    p.guidance.relief_s_m = Grid<float>(420, 420, 10.F);
    for (const auto [x, y] : test::cells(420, 420))
      if (x % 70 < 20) p.guidance.land_cover(x, y) = beside;
    std::size_t ways = 0;
    over_seeds(p, [&] { ways += ways_of(plan_ice(p.guidance, p.parameters), stream).size(); });
    return ways;
  };
  for (const Stream stream : {Stream::glacier_crevasses, Stream::glacier_flow_lines})
    EXPECT_GT(count(scree, stream), 2 * count(snow, stream)) << static_cast<int>(stream);
}

// A picture of three pixels per unit gives the same as one of one pixel per unit.
TEST(IcePlan, IsThatOfAPictureOfAnotherSize) {
  const Picture small = valley(1.0);
  const Picture large = valley(3.0);
  const IcePlan a = plan_ice(small.guidance, small.parameters);
  const IcePlan b = plan_ice(large.guidance, large.parameters);
  ASSERT_EQ(a.ways.size(), b.ways.size());
  for (std::size_t i = 0; i < a.ways.size(); ++i) {
    EXPECT_EQ(a.ways[i].stream, b.ways[i].stream);
    EXPECT_EQ(a.ways[i].cell, b.ways[i].cell);
    EXPECT_LT(glm::distance(a.ways[i].positions.front(), b.ways[i].positions.front()), 0.01F);
    EXPECT_NEAR(static_cast<double>(a.ways[i].positions.size()),
                static_cast<double>(b.ways[i].positions.size()), 1.0);
  }
}

// The plan of the small picture, used for the large one: as many strokes as with its own, on the
// same ground.
TEST(IcePlan, OfASmallPictureServesALargeOne) {
  const Picture small = valley(1.0);
  const Picture large = valley(3.0);
  const IcePlan plan = plan_ice(small.guidance, small.parameters);
  StrokeScene scene = large.scene();
  scene.window.ice = &plan;
  for (const StrokeKind& kind : stroke_kinds()) {
    if (!kind.on_ice) continue;
    const auto own = static_cast<double>(grow_strokes(kind.name, scene).size());
    const std::vector<Stroke> strokes = kind.grow(scene, kind.stream);
    EXPECT_GT(own, 4.0) << kind.name;
    EXPECT_NEAR(static_cast<double>(strokes.size()), own, 0.03 * own + 2.0) << kind.name;
    for (const Stroke& s : strokes) EXPECT_TRUE(is_ice(scene.class_at(s.source))) << kind.name;
  }
}

// Where a larger picture shows a stone or a ridge in front of the ice, no stroke starts on it.
TEST(IceWays, GrowFromTheirOwnGroundAlone) {
  Picture p = valley(1.0);
  const IcePlan plan = plan_ice(p.guidance, p.parameters);
  StrokeScene scene = p.scene();
  scene.window.ice = &plan;
  const StrokeKind& kind = find_stroke_kind("glacier moraines");
  const std::size_t before = kind.grow(scene, kind.stream).size();
  const IceWay way = ways_of(plan, Stream::glacier_moraines).front();
  EXPECT_TRUE(way_pixel(scene, way, 1));
  p.guidance.land_cover[scene.pixel(way.positions[1])] = rock;
  for (const std::size_t k : {4U, 5U}) p.guidance.depth_m[scene.pixel(way.positions[k])] *= 0.9F;
  for (const std::size_t k : {1U, 4U, 5U}) EXPECT_FALSE(way_pixel(scene, way, k));
  const std::vector<Stroke> strokes = kind.grow(scene, kind.stream);
  EXPECT_LT(strokes.size(), before);
  for (const Stroke& s : strokes) EXPECT_EQ(scene.class_at(s.source), glacier);
}

// Of two ribs side by side the shorter line joins the longer one, which is broader from there on.
TEST(Moraines, JoinAndWiden) {
  Picture p = plain_picture(glacier, 400, 500);
  p.guidance.depth_m = Grid<float>(400, 500, 8000.F);
  p.guidance.slope_deg = Grid<float>(400, 500, 10.F);
  const auto rib = [&](int x0, int x1, int y1) {
    for (const auto [x, y] : test::cells({x0, 0, x1, y1})) p.guidance.land_cover(x, y) = rock;
  };
  rib(140, 152, 80);
  rib(250, 262, 120);
  // Both streams turn to the middle.
  for (const auto [x, y] : test::cells(400, 500)) {
    const float aside = std::clamp((200.F - static_cast<float>(x)) / 50.F, -1.F, 1.F);
    p.guidance.fall_line(x, y) = glm::normalize(glm::vec2(0.6F * aside, 1.F));
  }
  const std::vector<IceWay> ways =
      ways_of(plan_ice(p.guidance, p.parameters), Stream::glacier_moraines);
  ASSERT_GE(ways.size(), 2U);
  float end = 0.F;
  for (const IceWay& way : ways) {
    ASSERT_EQ(way.half_width.size(), way.positions.size());
    ASSERT_EQ(way.across.size(), way.positions.size());
    EXPECT_GT(way.half_width.back(), 1.5F * way.half_width.front());
    EXPECT_LT(way.positions.front().y, 130.F) << "at the end of a rib";
    end = std::max(end, way.highest.y);
  }
  EXPECT_GT(end, 480.F);
}

// A unit of ground across the flow is what the picture shows of it.
TEST(IceGround, AcrossTheFlowIsForeshortened) {
  Picture p = plain_picture(glacier, 60, 60);
  p.guidance.depth_m = Grid<float>(60, 60, 8000.F);
  for (const auto [x, y] : test::cells(60, 60))
    p.guidance.position_m(x, y) =
        glm::vec3(30.F * static_cast<float>(x), -60.F * static_cast<float>(y), 900.F);
  const StrokeScene scene = p.scene();
  const glm::vec2 down = across_flow(scene, {30.F, 30.F}, {0.F, 1.F});
  EXPECT_NEAR(std::abs(down.x), 1.F, 1e-3F);
  EXPECT_NEAR(down.y, 0.F, 1e-3F);
  const glm::vec2 aside = across_flow(scene, {30.F, 30.F}, {1.F, 0.F});
  EXPECT_NEAR(aside.x, 0.F, 1e-3F);
  EXPECT_NEAR(std::abs(aside.y), 0.5F, 1e-3F);
}

}  // namespace
}  // namespace belvedere
