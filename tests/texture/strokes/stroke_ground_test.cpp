#include <gtest/gtest.h>

#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"

namespace belvedere {
namespace {

Picture sand_of(float slope_deg) {
  Picture p = plain_picture(LandCoverClass::sand, 320, 240);
  p.guidance.depth_m = Grid<float>(320, 240, 9000.F);
  for (const auto [x, y] : test::cells(320, 240))
    p.guidance.position_m(x, y) =
        glm::vec3(12.F * static_cast<float>(x), -12.F * static_cast<float>(y), 40.F);
  p.guidance.slope_deg = Grid<float>(320, 240, slope_deg);
  for (glm::vec2& d : p.guidance.fall_line) d = {0.8F, 0.6F};
  return p;
}

// Beaches and river bars: short level ripples, each crest over a darker and cooler trough.
TEST(Sand, LiesInLevelRipples) {
  const std::vector<Stroke> strokes = grow_strokes("sand", sand_of(2.F).scene());
  ASSERT_GT(strokes.size(), 2000U);
  ASSERT_EQ(strokes.size() % 2, 0U);
  double lighter = 0.0;
  for (std::size_t k = 0; k < strokes.size(); k += 2) {
    const Stroke& trough = strokes[k];
    const Stroke& crest = strokes[k + 1];
    EXPECT_LT(angle_deg(axis_of(crest), {1.F, 0.F}), 25.0);
    EXPECT_LT(glm::length(axis_of(crest)), 10.F);
    EXPECT_GT(trough.points[0].y, crest.points[0].y);
    lighter += static_cast<double>(crest.colour.r - trough.colour.r) /
               static_cast<double>(strokes.size() / 2);
  }
  // .7 of a step up, .45 down and the coolness, in greys that differ by .1.
  EXPECT_NEAR(lighter, 0.07 + 0.045 + 0.02, 0.01);
}

// Dunes: ripples run across their slope, whatever its direction.
TEST(Sand, RipplesRunAcrossADune) {
  const Picture p = sand_of(20.F);
  for (const Stroke& s : grow_strokes("sand", p.scene()))
    EXPECT_GT(angle_deg(axis_of(s), {0.8F, 0.6F}), 65.0);
}

TEST(Sand, GathersInPatchesAndOnlyOnSand) {
  Picture p = sand_of(2.F);
  Grid<int> counts(8, 6, 0);
  for (const Stroke& s : grow_strokes("sand", p.scene()))
    ++counts(static_cast<int>(s.source) % 320 / 40, static_cast<int>(s.source) / 320 / 40);
  EXPECT_GT(*std::max_element(counts.begin(), counts.end()),
            2 * *std::min_element(counts.begin(), counts.end()));
  for (LandCoverClass& id : p.guidance.land_cover) id = LandCoverClass::scree;
  EXPECT_TRUE(grow_strokes("sand", p.scene()).empty());
}

}  // namespace
}  // namespace belvedere
