#include "renderer/paint/base_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/paint/ground/base_surroundings.h"
#include "renderer/paint/sky.h"
#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"
#include "tests/renderer/paint/hills_print.h"
#include "tests/renderer/paint/near_colours.h"
#include "texture/strokes/parcels.h"

namespace belvedere {
namespace {

using test::cut;
using test::make_hills;
using test::make_slope;
using test::with_margin;

BasePicture picture_of(const GuidanceBuffers& g, const BaseParameters& p = {},
                       const char* palette = "summer") {
  return make_base_picture(g, read_palette(palette), p, {0, 0}, {g.width(), g.height()},
                           silent_progress());
}

BaseParameters plain() {
  BaseParameters p;
  p.air.haze = p.air.range_mist = p.air.warm_near = p.air.hue_drift = p.air.clouds = 0.0;
  return p;
}

float luma(glm::vec3 c) { return 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b; }

TEST(Base, IsTheRampWhereEverythingElseIsOff) {
  const GuidanceBuffers g = make_slope(30, 20, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 10.0F);
  const Palette palette = read_palette("summer");
  const BasePicture base = picture_of(g, plain());
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(base.colour(15, 10)[k],
                palette_colour(palette, LandCoverClass::pasture, 1200.0, 0.6)[k], 1e-6F);
    EXPECT_NEAR(base.darker(15, 10)[k],
                palette_colour(palette, LandCoverClass::pasture, 1200.0, 0.6 - 0.17)[k], 1e-6F);
    EXPECT_NEAR(base.lighter(15, 10)[k],
                palette_colour(palette, LandCoverClass::pasture, 1200.0, 0.6 + 0.17)[k], 1e-6F);
  }
}

TEST(Base, RockHasTheHueOfItsPlaneAndTurfAndSnowOnItsTreads) {
  GuidanceBuffers g = make_slope(30, 20, LandCoverClass::rock, {0.0F, 0.0F, 1.0F}, 50.0F);
  const Palette palette = read_palette("summer");
  const glm::vec3 ramp = palette_colour(palette, LandCoverClass::rock, 1200.0, 0.6);
  g.rock_facet = Grid<std::uint32_t>(30, 20, 0x00070009U);
  g.rock_cover = Grid<glm::vec2>(30, 20, glm::vec2(0.0F));
  const BaseParameters p = plain();
  const auto expect = [&](glm::vec3 expected) {
    const glm::vec3 found = picture_of(g, p).colour(15, 10);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 1e-5F) << k;
  };
  expect(ramp * rock_hue(*p.rock, 0x00070009U, 0.0F));
  g.rock_cover = Grid<glm::vec2>(30, 20, glm::vec2(0.0F, 1.0F));
  expect(palette_colour(palette, LandCoverClass::snow, 1200.0, 0.66));
  g.rock_cover = Grid<glm::vec2>(30, 20, glm::vec2(1.0F, 0.0F));
  expect(palette_colour(palette, LandCoverClass::alpine_grass, 1200.0, 0.55));
}

// Cream in the sun, and violet where steep shade does not see the sky.
TEST(Base, NearSnowIsWarmInLightAndVioletInShade) {
  const auto hue = [](float tone, float slope_deg, float metres_per_unit) {
    GuidanceBuffers g = make_slope(30, 20, LandCoverClass::snow, {0.0F, 0.0F, 1.0F}, slope_deg);
    g.tone = Grid<float>(30, 20, tone);
    g.footprint_m = Grid<float>(30, 20, metres_per_unit);
    return picture_of(g, plain()).colour(15, 10);
  };
  const glm::vec3 lit = hue(0.95F, 20.0F, 8.0F) / hue(0.95F, 20.0F, 40.0F);
  EXPECT_LT(lit.b, 0.99F);
  EXPECT_GE(lit.r, 1.0F);
  const glm::vec3 shade = hue(0.2F, 45.0F, 8.0F) / hue(0.2F, 45.0F, 40.0F);
  EXPECT_GT(shade.r, 1.02F);
  EXPECT_LT(shade.g, 0.99F);
}

// Ice is blue near ice-free ground; deep in the snow it is white with firn.
TEST(Base, TonguesAreIceAndFirnIsSnow) {
  GuidanceBuffers g = make_slope(200, 40, LandCoverClass::glacier, {0.0F, 0.0F, 1.0F}, 10.0F);
  g.footprint_m = Grid<float>(200, 40, 40.0F);
  for (const auto [x, y] : test::cells(20, 40)) g.land_cover(x, y) = LandCoverClass::scree;
  const Palette palette = read_palette("summer");
  const BasePicture base = picture_of(g, plain());
  const glm::vec3 ice = palette_colour(palette, LandCoverClass::glacier, 1200.0, 0.6);
  const glm::vec3 snow = palette_colour(palette, LandCoverClass::snow, 1200.0, 0.6);
  EXPECT_LT(glm::length(base.colour(22, 20) - ice), 1e-5F);
  EXPECT_LT(glm::length(base.colour(180, 20) - snow), 1e-5F);
  EXPECT_GT(glm::length(ice - snow), 0.05F);
  const float from_ice =
      glm::length(picture_of(g, plain(), "winter").colour(22, 20) -
                  palette_colour(read_palette("winter"), LandCoverClass::glacier, 1200.0, 0.6));
  EXPECT_GT(from_ice, 0.01F) << "in winter tongues are covered by snow";
}

// Lit ground reflects warm light into the shade of a wall, at its foot and nowhere else.
TEST(Base, ShadeOfWallsIsWarmAtTheirFoot) {
  GuidanceBuffers g = make_slope(30, 120, LandCoverClass::rock, {0.0F, 0.0F, 1.0F}, 50.0F);
  for (const auto [x, y] : test::cells({0, 90, 30, 120}))
    g.land_cover(x, y) = LandCoverClass::alpine_grass;
  g.rock_facet = Grid<std::uint32_t>(30, 120, 0x00070009U);
  g.rock_cover = Grid<glm::vec2>(30, 120, glm::vec2(0.0F));
  const auto warmth = [&](float tone, int y) {
    g.tone = Grid<float>(30, 120, tone);
    const glm::vec3 colour = picture_of(g, plain()).colour(15, y);
    return colour.r / colour.b;
  };
  EXPECT_GT(warmth(0.08F, 88), 1.15F * warmth(0.08F, 40));
  EXPECT_NEAR(warmth(0.7F, 88), warmth(0.7F, 40), 1e-4F) << "in the sun there is none";
}

// Pale and warm, and never as white as snow; in winter it has as much snow cover as scree.
TEST(Base, SandIsPaleAndWarm) {
  const GuidanceBuffers g = make_slope(30, 20, LandCoverClass::sand, {0.0F, 0.0F, 1.0F}, 2.0F);
  for (const char* season :
       {"summer", "autumn", "winter", "desert", "high_desert", "steppe", "evening", "morning"}) {
    const Palette palette = read_palette(season);
    const glm::vec3 colour = picture_of(g, plain(), season).colour(15, 10);
    EXPECT_GT(luma(colour), luma(palette_colour(palette, LandCoverClass::rock, 1200.0, 0.6)))
        << season;
    EXPECT_LT(luma(colour), luma(palette_colour(palette, LandCoverClass::snow, 1200.0, 0.6)))
        << season;
    if (!palette.winter) {
      EXPECT_GT(colour.r, colour.b) << season;
    }
  }
  const GuidanceBuffers rubble =
      make_slope(30, 20, LandCoverClass::scree, {0.0F, 0.0F, 1.0F}, 2.0F);
  const glm::vec3 sand = picture_of(g, plain(), "winter").colour(15, 10);
  const glm::vec3 scree = picture_of(rubble, plain(), "winter").colour(15, 10);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sand[c], scree[c], 0.04F);
}

// Warm light shifts lit colours and leaves shade to the palette.
TEST(Base, ARegionsWarmthShiftsLitColoursAlone) {
  BaseParameters p = plain();
  const auto colours = [&](float tone, double warmth) {
    GuidanceBuffers g = make_slope(8, 8, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 10.0F);
    for (float& t : g.tone) t = tone;
    p.light_field = std::make_shared<const LightField>(
        glm::dvec3(0.0, 0.0, 1.0), glm::dvec2(1.0, 0.0),
        std::vector{LightRegion{.radius_m = 1e5, .warmth = warmth}}, std::vector<CloudShadow>(), 1);
    return picture_of(g, p).colour(4, 4);
  };
  const glm::vec3 lit = colours(0.9F, 0.0);
  const glm::vec3 warm = colours(0.9F, 0.5);
  EXPECT_NEAR(warm.r / lit.r, 1.05F, 1e-4F);
  EXPECT_NEAR(warm.b / lit.b, 0.92F, 1e-4F);
  EXPECT_NEAR(colours(0.9F, -0.5).b / lit.b, 1.08F, 1e-4F);
  EXPECT_EQ(colours(0.2F, 1.0), colours(0.2F, 0.0));
}

TEST(Base, FarGroundTurnsIntoAirAndNearGroundIsWarm) {
  BaseParameters p = plain();
  p.air.haze = 1.0;
  p.air.warm_near = 1.0;
  GuidanceBuffers g = make_slope(8, 8, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 10.0F);
  for (float& a : g.altitude_m) a = 500.0F;
  const Palette palette = read_palette("summer");
  const glm::vec3 ramp = palette_colour(palette, LandCoverClass::pasture, 500.0, 0.6);
  const glm::vec3 near = picture_of(g, p).colour(4, 4);
  EXPECT_NEAR(near.r, ramp.r * (1.0F + 0.06F * 0.6F), 1e-5F);
  EXPECT_NEAR(near.b, ramp.b * (1.0F - 0.07F * 0.6F), 1e-5F);
  for (float& d : g.depth_m) d = 900000.0F;
  const BasePicture far = picture_of(g, p);
  EXPECT_LT(glm::length(far.colour(4, 4) - palette.haze_far), 0.01F);
  EXPECT_GT(far.haze(4, 4), 0.99F);
}

// Slopes of forest whose end runs down the picture: 500 m of ground a column.
GuidanceBuffers make_end(float relief_l_m) {
  GuidanceBuffers g = make_slope(9, 6, LandCoverClass::forest, {0.0F, 0.0F, 1.0F}, 10.0F);
  g.rim_m = Grid<float>(9, 6);
  for (const auto [x, y] : test::cells(9, 6)) g.rim_m(x, y) = 500.0F * static_cast<float>(x);
  for (float& d : g.depth_m) d = 20000.0F;
  g.relief_l_m = Grid<float>(9, 6, relief_l_m);
  return g;
}

// Towards its end low terrain first turns into blue air, and only the last strip into the colour
// beyond.
TEST(Base, TerrainEndsInAir) {
  const Palette palette = read_palette("summer");
  BaseParameters p = plain();
  p.air.rim_fade_m = 0.0;
  const BasePicture full = picture_of(make_end(0.0F), p);
  p.air.rim_fade_m = 3000.0;
  p.horizon_px = 4.0;
  const BasePicture base = picture_of(make_end(0.0F), p);
  const auto step = [](double t) { return static_cast<float>((3.0 - 2.0 * t) * t * t); };
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 9; ++x) {
      const float air = 0.86F * (1.0F - step(std::min(1.0, 500.0 * x / 3000.0)));
      const float gone = 1.0F - step(std::min(1.0, 500.0 * x / (0.38 * 3000.0)));
      const glm::vec3 beyond = air_beyond(palette, (y + 0.5) / 4.0);
      const auto expected = [&](float colour, int k) {
        return (colour * (1.0F - air) + palette.haze_near[k] * air) * (1.0F - gone) +
               beyond[k] * gone;
      };
      for (int k = 0; k < 3; ++k) {
        ASSERT_NEAR(base.colour(x, y)[k], expected(full.colour(x, y)[k], k), 1e-6F)
            << x << ", " << y;
        ASSERT_NEAR(base.darker(x, y)[k], expected(full.darker(x, y)[k], k), 1e-6F);
        ASSERT_NEAR(base.lighter(x, y)[k], expected(full.lighter(x, y)[k], k), 1e-6F);
      }
      ASSERT_NEAR(base.haze(x, y), 1.0F - (1.0F - air) * (1.0F - gone), 1e-6F);
    }
  EXPECT_GT(glm::length(base.colour(3, 2) - full.colour(3, 2)), 0.2F);
}

TEST(Base, NoCrestIsLeftOverGroundThatEnds) {
  BaseParameters p = plain();
  p.air.rim_fade_m = 4000.0;
  const BasePicture low = picture_of(make_end(0.0F), p);
  const BasePicture high = picture_of(make_end(400.0F), p);
  EXPECT_EQ(high.haze, low.haze);
  EXPECT_GT(low.haze(0, 3), 0.99F);
}

// A ridge at 30 km and behind it, from 52 km on, either hills with hollows 200 m below their
// surroundings or a mountain, whose foot lies far deeper below its summit. The end of the data is
// 16 km behind the foot.
constexpr int foot_row = 50;
GuidanceBuffers make_far_ground(bool mountain) {
  GuidanceBuffers g = make_slope(60, 80, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 25.0F);
  for (const auto [x, y] : test::cells(60, 80)) {
    const auto up = static_cast<float>(foot_row - y);
    g.altitude_m(x, y) = 4000.0F;
    g.depth_m(x, y) = up < 0.0F ? 30000.0F : 52000.0F + 200.0F * up;
    g.rim_m(x, y) = 68000.0F - g.depth_m(x, y);
    if (up < 0.0F) continue;
    g.altitude_m(x, y) += mountain ? 60.0F * up : 0.0F;
    g.relief_l_m(x, y) = mountain ? -700.0F + 45.0F * up : -200.0F;
  }
  return g;
}

TEST(Base, TheFootOfAHighMountainIsCoveredNoMoreThanOtherGroundAtItsDistance) {
  const Palette palette = read_palette("summer");
  BaseParameters p;
  p.air.from_m = 24000.0;
  p.air.scale_m = 32000.0;
  p.air.rim_fade_m = 4000.0;
  p.pixels_per_unit = 0.5;
  const GuidanceBuffers g = make_far_ground(true);
  const Grid<float> mountain = picture_of(g, p).haze;
  const Grid<float> hills = picture_of(make_far_ground(false), p).haze;
  for (const auto [x, y] : test::cells({0, foot_row - 10, 60, foot_row + 1})) {
    ASSERT_LE(mountain(x, y), hills(x, y) + 1e-4F) << x << ' ' << y;
    // Mist in hollows and at edges is a veil over what air leaves of the ground.
    const double depth = g.depth_m(x, y);
    const float air =
        air_share(p.air, palette, depth, g.altitude_m(x, y), farness(p.air, depth), 0.0F);
    ASSERT_GE(1.0F - mountain(x, y), 0.6F * (1.0F - air) - 1e-4F) << x << ' ' << y;
  }
}

// Steep crests, one behind the other in clear air beyond the foreground: each lighter and bluer
// than the one before.
TEST(Base, FarRangesGrowPale) {
  const BaseParameters p;
  const Palette palette = read_palette("summer");
  float last = 0.0F;
  for (const float depth : {50000.0F, 65000.0F, 80000.0F, 95000.0F, 110000.0F}) {
    GuidanceBuffers g = make_slope(8, 8, LandCoverClass::forest, {0.0F, 0.0F, 1.0F}, 30.0F);
    for (float& d : g.depth_m) d = depth;
    for (float& r : g.relief_l_m) r = 300.0F;
    const glm::vec3 colour = picture_of(g, p).colour(4, 4);
    EXPECT_GT(luma(colour), last + 0.015F) << depth;
    last = luma(colour);
    if (depth > 80000.0F) {
      EXPECT_LT(glm::length(colour - palette.haze_far), 0.45F) << depth;
    }
  }
}

// Hollows of far ranges hold mist, deep here and none there; their crests and near ground none.
TEST(Base, MistOfFarRangesIsOfUnlikeDepth) {
  const auto spread = [](float depth_m, float relief_l_m) {
    GuidanceBuffers g = make_slope(400, 60, LandCoverClass::forest, {0.0F, 0.0F, 1.0F}, 20.0F);
    for (float& d : g.depth_m) d = depth_m;
    for (float& r : g.relief_l_m) r = relief_l_m;
    const BasePicture base = picture_of(g, BaseParameters{});
    const auto [low, high] = std::minmax_element(base.haze.begin(), base.haze.end());
    return *high - *low;
  };
  EXPECT_GT(spread(80000.0F, -160.0F), 0.10F);
  EXPECT_LT(spread(80000.0F, 100.0F), 1e-5F);
  EXPECT_LT(spread(20000.0F, -160.0F), 1e-5F);
}

// Mist behind an edge lies in the valley and leaves a crest clear.
TEST(Base, MistLiesInValleys) {
  const auto behind_edge = [](float relief_l_m) {
    GuidanceBuffers g = make_slope(20, 160, LandCoverClass::forest, {0.0F, 0.0F, 1.0F}, 10.0F);
    for (const auto [x, y] : test::cells(20, 80)) g.depth_m(x, y) = 32000.0F;
    for (float& r : g.relief_l_m) r = relief_l_m;
    BaseParameters p = plain();
    p.air.range_mist = 1.0;
    const BasePicture base = picture_of(g, p);
    return luma(base.colour(10, 78)) - luma(base.colour(10, 20));
  };
  EXPECT_GT(behind_edge(-100.0F), 0.05F);
  EXPECT_EQ(behind_edge(-100.0F), behind_edge(0.0F));
  EXPECT_NEAR(behind_edge(300.0F), 0.25F * behind_edge(0.0F), 0.02F);
}

// Grass in hollows is greener, on ridges yellower, than between.
TEST(Base, GrassIsGreenerInHollows) {
  GuidanceBuffers g = make_slope(60, 40, LandCoverClass::alpine_grass, {0.0F, 0.0F, 1.0F}, 20.0F);
  BaseParameters p = plain();
  p.air.hue_drift = 1.0;
  const auto greenness = [&](float relief_m) {
    for (float& r : g.relief_s_m) r = relief_m;
    const glm::vec3 c = picture_of(g, p).colour(30, 20);
    return c.g - c.r;
  };
  EXPECT_GT(greenness(-12.0F), greenness(0.0F) + 0.01F);
  EXPECT_LT(greenness(12.0F), greenness(0.0F) - 0.005F);
}

TEST(Base, RangesReadApart) {
  // A near range in front of a far one of the same colour: the far side lightens towards the edge,
  // the near side darkens.
  GuidanceBuffers g = make_slope(20, 160, LandCoverClass::forest, {0.0F, 0.0F, 1.0F}, 10.0F);
  for (const auto [x, y] : test::cells(20, 80)) g.depth_m(x, y) = 32000.0F;
  BaseParameters p = plain();
  p.air.range_mist = 1.0;
  const BasePicture base = picture_of(g, p);
  EXPECT_GT(luma(base.colour(10, 78)), luma(base.colour(10, 20)) + 0.05F);
  EXPECT_LT(luma(base.colour(10, 81)), luma(base.colour(10, 140)) - 0.02F);
  EXPECT_GT(base.accent(10, 80), 0.5F);
  EXPECT_EQ(base.accent(10, 79), 0.0F);
}

TEST(Base, AccentsFollowRelief) {
  GuidanceBuffers g = make_slope(12, 12, LandCoverClass::rock, {0.0F, 0.0F, 1.0F}, 40.0F);
  for (float& t : g.relief_s_m) t = -4.5F;
  EXPECT_NEAR(picture_of(g).accent(6, 6), -0.45F, 1e-6F);
  for (LandCoverClass& id : g.land_cover) id = LandCoverClass::snow;
  EXPECT_NEAR(picture_of(g).accent(6, 6), -0.3F, 1e-6F);
}

TEST(Base, ForestThinsTowardsItsBorderAndDwarfPineStandsThere) {
  GuidanceBuffers g = make_slope(60, 60, LandCoverClass::forest, {0.0F, 0.0F, 1.0F}, 20.0F);
  for (const auto [x, y] : test::cells(60, 60)) {
    g.position_m(x, y) = glm::vec3(40.0F * x, -40.0F * y, 1800.0F);
    if (y < 30) g.land_cover(x, y) = LandCoverClass::alpine_grass;
  }
  const BasePicture base = picture_of(g);
  double inside = 0.0, border = 0.0, above = 0.0, high = 0.0;
  for (int x = 0; x < 60; ++x) {
    inside += base.tree_density(x, 55) / 60.0;
    border += base.tree_density(x, 31) / 60.0;
    above += base.tree_density(x, 26) / 60.0;
    high += base.tree_density(x, 0) / 60.0;
  }
  EXPECT_GT(inside, 0.65);
  EXPECT_LT(border, 0.7 * inside);
  EXPECT_GT(above, 0.1);
  EXPECT_LT(high, 0.05);
}

TEST(Base, RiversHaveBanksOfGravelHereAndThere) {
  GuidanceBuffers g = make_slope(60, 600, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 1.0F);
  for (const auto [x, y] : test::cells(60, 600)) {
    g.position_m(x, y) =
        glm::vec3(20.0F * static_cast<float>(x), -20.0F * static_cast<float>(y), 600.0F);
    if (x >= 28 && x < 32) g.land_cover(x, y) = LandCoverClass::water;
  }
  const BasePicture base = picture_of(g, plain());
  int gravel = 0;
  for (int y = 0; y < 600; ++y) {
    const float blue = base.colour(5, y).b;  // gravel is greyer than grass
    gravel += base.colour(32, y).b > blue + 0.1F ? 1 : 0;
    EXPECT_NEAR(base.colour(40, y).b, blue, 1e-6F);
  }
  EXPECT_GT(gravel, 100);
  EXPECT_LT(gravel, 450);
}

TEST(Base, PartEqualsWhole) {
  for (const double ppu : {1.0, 2.5}) {
    const int width = ppu > 1.0 ? 640 : 300;
    const int height = ppu > 1.0 ? 560 : 260;
    GuidanceBuffers hills = make_hills(width, height, ppu);
    for (std::size_t i = 0; i < hills.tone.size(); ++i) hills.tone[i] = hills.sky_view[i] * 0.8F;
    BaseParameters p;
    p.pixels_per_unit = ppu;
    const Palette palette = read_palette("summer");
    const BasePicture whole = picture_of(hills, p);
    const PixelRect kept{width / 2 - 20, height / 2 - 30, width / 2 + 21, height / 2 + 9};
    const PixelRect part = with_margin(kept, base_margin_px(p), width, height);
    ASSERT_GT(part.x0, 0);
    const BasePicture base = make_base_picture(cut(hills, part), palette, p, {part.x0, part.y0},
                                               {width, height}, silent_progress());
    for (const auto [x, y] : test::cells(kept)) {
      const int px = x - part.x0, py = y - part.y0;
      ASSERT_EQ(base.colour(px, py), whole.colour(x, y)) << x << " " << y << " ppu " << ppu;
      ASSERT_EQ(base.darker(px, py), whole.darker(x, y));
      ASSERT_EQ(base.lighter(px, py), whole.lighter(x, y));
      ASSERT_EQ(base.accent(px, py), whole.accent(x, y));
      ASSERT_EQ(base.tree_density(px, py), whole.tree_density(x, y));
      ASSERT_EQ(base.haze(px, py), whole.haze(x, y));
    }
  }
}

TEST(Base, OfAPrintLooksAroundInItsWideView) {
  test::Print print;
  for (std::size_t i = 0; i < print.near.tone.size(); ++i)
    print.near.tone[i] = print.near.sky_view[i] * 0.8F;
  BaseParameters p;
  p.pixels_per_unit = test::print_ppu;
  const Palette palette = read_palette("summer");
  // A lake, which searches up and down for its shores, and level ground above it, which searches
  // for water.
  for (const auto [x, y] : test::cells({300, 690, 1100, 1000}))
    print.near.land_cover(x, y) = y < 760 ? LandCoverClass::valley_floor : LandCoverClass::water;
  const glm::ivec2 size{print.width, print.height};
  const BasePicture whole = make_base_picture(print.near, {print.far, test::print_factor}, palette,
                                              p, {0, 0}, size, silent_progress());
  for (const PixelRect kept : {PixelRect{640, 520, 700, 570}, PixelRect{640, 735, 700, 758},
                               PixelRect{640, 880, 700, 900}}) {
    const Grid<LandCoverClass> classes = test::cut(print.near.land_cover, kept);
    const bool has_water =
        std::find(classes.begin(), classes.end(), LandCoverClass::water) != classes.end();
    const test::Window near = test::window_of(print.near, base_window(kept, has_water, p));
    const test::Window far =
        test::window_of(print.far, wide_rect(grown(kept, base_margin_px(p)), test::print_factor));
    const BasePicture part =
        make_base_picture(near.held, {far.held, test::print_factor, {far.rect.x0, far.rect.y0}},
                          palette, p, {near.rect.x0, near.rect.y0}, size, silent_progress(),
                          moved(kept, -near.rect.x0, -near.rect.y0));
    EXPECT_TRUE(part.colour == test::cut(whole.colour, kept));
    EXPECT_TRUE(part.accent == test::cut(whole.accent, kept));
    EXPECT_TRUE(part.tree_density == test::cut(whole.tree_density, kept));
    EXPECT_TRUE(part.haze == test::cut(whole.haze, kept));
  }
  const BasePicture own =
      make_base_picture(print.near, palette, p, {0, 0}, size, silent_progress());
  double squares = 0.0;
  for (std::size_t i = 0; i < own.colour.size(); ++i) {
    const glm::vec3 off = own.colour[i] - whole.colour[i];
    squares += glm::dot(off, off) / 3.0F;
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(own.colour.size())), 0.01);
}

TEST(Base, SameBitsForAnyThreads) {
  const GuidanceBuffers hills = make_hills(180, 140);
  const BasePicture many = picture_of(hills);
  const ThreadLimit limit(1);
  const BasePicture one = picture_of(hills);
  EXPECT_EQ(one.colour, many.colour);
  EXPECT_EQ(one.lighter, many.lighter);
  EXPECT_EQ(one.tree_density, many.tree_density);
}

TEST(Base, MissingToneIsAnError) {
  GuidanceBuffers g = make_slope(8, 8, LandCoverClass::rock, {0.0F, 0.0F, 1.0F}, 10.0F);
  g.tone = {};
  EXPECT_THROW(picture_of(g), Error);
}

using test::expect_near;

// A position in the centre of a field.
Parcel open_field(Crop crop) {
  return {.crop = crop,
          .shade = 0.0F,
          .border_m = 45.0F,
          .width_m = 90.0F,
          .lane_m = 400.0F,
          .hedged = false};
}

TEST(Fields, AreCropsNearByAndOneColourFarAway) {
  const glm::vec3 apart = crop_colour(Crop::ripe) - mean_crop_colour();
  const auto colour = [](float metres_per_unit, float air) {
    return field_colour(open_field(Crop::ripe), 0.0F, metres_per_unit, air, 1.0F);
  };
  expect_near(colour(0.0F, 0.0F), mean_crop_colour() + 1.15F * apart);
  expect_near(colour(9.0F, 0.0F), mean_crop_colour() + 1.15F * apart);
  expect_near(colour(12.0F, 0.0F), mean_crop_colour() + 0.85F * apart);
  expect_near(colour(90.0F, 0.0F), mean_crop_colour() + 0.55F * apart);
  expect_near(colour(90.0F, 1.0F), mean_crop_colour() + 0.55F * 0.65F * apart);
}

TEST(Fields, GiveWayToHayTowardsTheSlopes) {
  const auto colour = [](float slope_deg) {
    return field_colour(open_field(Crop::ripe), slope_deg, 0.0F, 0.0F, 1.0F);
  };
  EXPECT_EQ(colour(3.0F), colour(0.0F));
  expect_near(colour(4.25F), 0.5F * (colour(0.0F) + crop_colour(Crop::hay)));
  expect_near(colour(5.5F), crop_colour(Crop::hay));
}

TEST(Fields, HaveDarkBordersAndPaleLanes) {
  Parcel parcel = open_field(Crop::clover);
  const glm::vec3 centre = field_colour(parcel, 0.0F, 18.0F, 0.0F, 1.0F);
  parcel.border_m = 0.0F;
  expect_near(field_colour(parcel, 0.0F, 18.0F, 0.0F, 1.0F), centre * (1.0F - 0.05F * 0.55F));
  parcel.hedged = true;
  expect_near(field_colour(parcel, 0.0F, 18.0F, 0.0F, 1.0F), centre * (1.0F - 0.13F * 0.55F));
  Parcel lane = open_field(Crop::clover);
  lane.lane_m = 0.0F;
  const float share = 0.55F * 0.55F;
  expect_near(field_colour(lane, 0.0F, 18.0F, 0.0F, 1.0F),
              centre * (1.0F - share) + glm::vec3(1.02F, 0.99F, 1.05F) * share);
}

TEST(Fields, AreAsStrongAsHueDriftSays) {
  EXPECT_EQ(field_colour(open_field(Crop::ploughed), 0.0F, 0.0F, 0.0F, 0.0F), glm::vec3(1.0F));
  const glm::vec3 once = field_colour(open_field(Crop::ploughed), 0.0F, 0.0F, 0.0F, 1.0F);
  expect_near(field_colour(open_field(Crop::ploughed), 0.0F, 0.0F, 0.0F, 2.0F),
              1.0F + 2.0F * (once - 1.0F));
}

constexpr glm::vec3 street(0.5F, 0.4F, 0.3F);

TEST(TownGround, HasMoreGardensInAVillageThanInATown) {
  const Palette palette = read_palette("summer");
  const glm::vec3 lawn = crop_colour(Crop::grass) *
                         palette_colour(palette, LandCoverClass::valley_floor, 700.0, 0.6 - 0.08);
  expect_near(town_ground_colour(palette, street, 0.0F, 700.0, 0.6, 1.0F, 50.0F),
              glm::mix(street, lawn, 0.80F));
  expect_near(town_ground_colour(palette, street, 1.0F, 700.0, 0.6, 1.0F, 50.0F),
              glm::mix(street, lawn, 0.30F));
  EXPECT_EQ(town_ground_colour(palette, street, 5.0F, 700.0, 0.6, 1.0F, 50.0F),
            town_ground_colour(palette, street, 1.0F, 700.0, 0.6, 1.0F, 50.0F));
}

// Where villages are drawn house by house, a place reads as one pale patch with a soft edge.
TEST(TownGround, IsPaleAroundHousesThatAreDrawnOneByOne) {
  const Palette palette = read_palette("summer");
  const auto at = [&](float built, float metres_per_unit) {
    return town_ground_colour(palette, street, built, 700.0, 0.6, 1.0F, metres_per_unit);
  };
  const glm::vec3 pale = glm::vec3(0.74F, 0.70F, 0.60F) * (0.55F + 0.60F * 0.6F);
  expect_near(at(0.4F, 8.0F), glm::mix(at(0.4F, 50.0F), pale, 0.35F));
  EXPECT_EQ(at(0.01F, 8.0F), at(0.01F, 50.0F)) << "single houses stand in meadows";
  expect_near(at(0.10F, 8.0F), glm::mix(at(0.10F, 50.0F), pale, 0.35F * 0.5F));
}

TEST(TownGround, LiesUnderSnowInWinter) {
  const Palette palette = read_palette("winter");
  const glm::vec3 snow = palette_colour(palette, LandCoverClass::snow, 700.0, 0.6 - 0.08);
  expect_near(town_ground_colour(palette, street, 0.0F, 700.0, 0.6, 1.0F, 50.0F),
              glm::mix(street, snow, 0.80F));
}

}  // namespace
}  // namespace belvedere
