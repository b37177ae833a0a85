#include "renderer/paint/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"
#include "tests/renderer/paint/hills_print.h"

namespace belvedere {
namespace {

using test::cut;
using test::make_hills;
using test::make_slope;
using test::mean;
using test::with_margin;

const glm::vec3 sun_side_normal(-0.612F, 0.612F, 0.5F);

Grid<float> tone_of(const GuidanceBuffers& guidance, const ToneParameters& parameters = {}) {
  return make_tone(guidance, parameters, {0, 0}, silent_progress());
}

TEST(Tone, GrowsWithLight) {
  // Slopes turned step by step from the sun's side to the far side.
  double lighter = 2.0;
  for (double angle = 0.0; angle < 1.8; angle += 0.2) {
    const glm::vec3 towards = glm::normalize(sun_side_normal);
    const glm::vec3 side = glm::normalize(glm::vec3(1.0F, 1.0F, 0.0F));
    const glm::vec3 normal =
        towards * static_cast<float>(std::cos(angle)) + side * static_cast<float>(std::sin(angle));
    const double tone = mean(tone_of(make_slope(24, 24, LandCoverClass::pasture, normal, 10.0F)));
    EXPECT_LT(tone, lighter) << "angle " << angle;
    lighter = tone;
  }
}

TEST(Tone, ShadowTakesItsShareOfTheSun) {
  GuidanceBuffers lit = make_slope(24, 24, LandCoverClass::pasture, sun_side_normal, 10.0F);
  GuidanceBuffers dark = lit;
  for (float& s : dark.shadow) s = 0.0F;
  ToneParameters p;
  p.light.sun = 0.6;  // full light must not clip here
  // The sun alone gives sun_strength on this slope; a cast shadow removes shadow_depth of it, and
  // tone is light / 0.98.
  for (const double depth : {0.3, 0.78}) {
    p.light.shadow_depth = depth;
    EXPECT_NEAR(mean(tone_of(lit, p)) - mean(tone_of(dark, p)), 0.6 * depth / 0.98, 1e-3);
  }
}

// A cone seen from above, as normals and positions: its eastern half under a region's sun in the
// east, the rest under one in the west.
GuidanceBuffers make_cone(int size) {
  GuidanceBuffers g = make_slope(size, size, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 30.0F);
  for (const auto [x, y] : test::cells(size, size)) {
    const glm::vec2 out = glm::vec2(static_cast<float>(x), static_cast<float>(-y)) +
                          glm::vec2(0.5F - 0.5F * size, 0.5F * size - 0.5F);
    g.position_m(x, y) = glm::vec3(10.0F * out, 1200.0F);
    g.normal(x, y) = g.normal_detail(x, y) = g.normal_smooth(x, y) =
        glm::normalize(glm::vec3(glm::normalize(out), 1.0F));
  }
  return g;
}

TEST(Tone, AConeIsLitFromTwoSides) {
  const GuidanceBuffers cone = make_cone(96);
  const glm::dvec3 west = glm::normalize(glm::dvec3(-1.0, 0.2, 0.7));
  const glm::dvec3 east = glm::normalize(glm::dvec3(1.0, 0.2, 0.7));
  ToneParameters from_west;
  from_west.sun_direction = west;
  from_west.sun_image_x = -1.0;
  from_west.ribs = 0.0;
  ToneParameters from_east = from_west;
  from_east.sun_direction = east;
  from_east.sun_image_x = 1.0;
  ToneParameters both = from_west;
  const LightRegion half{.rings = {{{100, -1000}, {1000, -1000}, {1000, 1000}, {100, 1000}}},
                         .blend_m = 200.0,
                         .sun_direction = east};
  both.light_field = std::make_shared<const LightField>(
      west, glm::dvec2(1.0, 0.0), std::vector{half}, std::vector<CloudShadow>(), 1);
  const Grid<float> tone = tone_of(cone, both);
  const Grid<float> left = tone_of(cone, from_west);
  const Grid<float> right = tone_of(cone, from_east);
  for (const auto [x, y] : test::cells(96, 96)) {
    const float at = cone.position_m(x, y).x;
    if (at < -100.0F) {
      ASSERT_EQ(tone(x, y), left(x, y));
    } else if (at > 100.0F) {
      ASSERT_NEAR(tone(x, y), right(x, y), 1e-5F);
    } else if (std::abs(at) < 10.0F && y % 24 == 0) {
      // Half of each: the sum of both suns, which is higher and in the north.
      ToneParameters centre = from_west;
      centre.sun_direction = both.light_field->at({static_cast<double>(at), 0.0}).sun;
      EXPECT_NEAR(tone(x, y), tone_of(cone, centre)(x, y), 1e-5F);
    }
  }
  EXPECT_GT(tone(10, 48), 0.7F);
  EXPECT_GT(tone(85, 48), 0.7F);
  EXPECT_LT(right(10, 48), 0.4F);
}

// A cloud removes its share of the sunlight and nothing of the sky's.
TEST(Tone, ACloudShadowTakesItsShareOfTheSun) {
  const GuidanceBuffers lit = make_slope(24, 24, LandCoverClass::pasture, sun_side_normal, 10.0F);
  ToneParameters p;
  p.light.sun = 0.6;
  ToneParameters clouded = p;
  clouded.light_field = std::make_shared<const LightField>(
      p.sun_direction, glm::dvec2(1.0, 0.0), std::vector<LightRegion>(),
      std::vector{
          CloudShadow{.centre = {0.0, 0.0}, .radius_m = 4000.0, .strength = 0.5, .blend_m = 500.0}},
      1);
  const float kept = clouded.light_field->at({0.0, 0.0}).strength;
  EXPECT_NEAR(mean(tone_of(lit, p)) - mean(tone_of(lit, clouded)),
              0.6 * (1.0 - static_cast<double>(kept)) / 0.98, 1e-3);
}

TEST(Tone, SkyViewAndReliefLighten) {
  const glm::vec3 away(0.612F, -0.612F, 0.9F);
  const GuidanceBuffers open = make_slope(24, 24, LandCoverClass::alpine_grass, away, 10.0F);
  GuidanceBuffers narrow = open;
  for (float& v : narrow.sky_view) v = 0.4F;
  EXPECT_GT(mean(tone_of(open)), mean(tone_of(narrow)) + 0.05);
  GuidanceBuffers high = open;
  for (float& t : high.relief_m_m) t = 70.0F;
  EXPECT_NEAR(mean(tone_of(high)) - mean(tone_of(open)), 0.04 / 0.98, 1e-3);
}

TEST(Tone, StaysInRange) {
  const GuidanceBuffers hills = make_hills(200, 160);
  const Grid<float> tone = tone_of(hills);
  double low = 1.0, high = 0.0;
  for (std::size_t i = 0; i < tone.size(); ++i) {
    EXPECT_GE(tone[i], 0.0F);
    EXPECT_LE(tone[i], 1.02F);
    if (hills.is_sky(i)) {
      EXPECT_EQ(tone[i], 0.0F);
    }
    low = std::min<double>(low, tone[i]);
    high = std::max<double>(high, tone[i]);
  }
  EXPECT_LT(low, 0.2);
  EXPECT_GT(high, 0.9);
}

TEST(Tone, OutcropsInTheWoodAreCalmerThanWalls) {
  // A slope of rock, lit in its left half and in shadow in its right one, and the same with forest
  // all around a small patch of each.
  GuidanceBuffers wall = make_slope(160, 80, LandCoverClass::rock, sun_side_normal, 45.0F);
  for (const auto [x, y] : test::cells({80, 0, 160, 80})) wall.shadow(x, y) = 0.0F;
  GuidanceBuffers outcrops = wall;
  const auto in_patch = [](int x, int y) {
    return std::abs(y - 40) < 6 && (std::abs(x - 40) < 6 || std::abs(x - 120) < 6);
  };
  for (const auto [x, y] : test::cells(160, 80))
    if (!in_patch(x, y)) outcrops.land_cover(x, y) = LandCoverClass::forest;
  ToneParameters p;
  p.ribs = 0.0;
  const auto patch = [&](const Grid<float>& tone, int centre) {
    double sum = 0.0;
    int count = 0;
    for (int y = 35; y <= 45; ++y)
      for (int x = centre - 5; x <= centre + 5; ++x, ++count)
        sum += static_cast<double>(tone(x, y));
    return sum / count;
  };
  const Grid<float> of_wall = tone_of(wall, p);
  const Grid<float> of_outcrops = tone_of(outcrops, p);
  EXPECT_LT(patch(of_outcrops, 40), patch(of_wall, 40) - 0.1) << "not white";
  EXPECT_LT(patch(of_outcrops, 40) - patch(of_outcrops, 120),
            0.7 * (patch(of_wall, 40) - patch(of_wall, 120)))
      << "less contrast";
}

TEST(Tone, OfRockIsThatOfItsRelief) {
  GuidanceBuffers wall = make_slope(24, 24, LandCoverClass::rock, sun_side_normal, 50.0F);
  const double plain = mean(tone_of(wall));
  wall.rock_tone = Grid<float>(24, 24, 0.7F);
  ToneParameters p;
  EXPECT_NEAR(mean(tone_of(wall, p)), 0.7, 0.06) << "pools of light alone move it";
  EXPECT_NE(mean(tone_of(wall, p)), plain);
  // The picture's contrast applies to it, around .55.
  p.light.contrast = 2.0;
  EXPECT_NEAR(mean(tone_of(wall, p)), 0.85, 0.12);
  // Other ground does not need it, unless it is near: then its forms add theirs.
  GuidanceBuffers meadow = make_slope(24, 24, LandCoverClass::pasture, sun_side_normal, 20.0F);
  meadow.footprint_m = Grid<float>(24, 24, 40.0F);
  const Grid<float> without = tone_of(meadow);
  meadow.rock_tone = Grid<float>(24, 24, 0.1F);
  EXPECT_TRUE(tone_of(meadow) == without);
  meadow.footprint_m = Grid<float>(24, 24, 5.0F);
  EXPECT_NEAR(mean(tone_of(meadow)), mean(without) + 0.1, 0.02);
}

TEST(Tone, WallsInShadowKeepTheirForms) {
  // Two planes in the deepest shade: both darker than the darkest paint would be, and they still
  // differ.
  GuidanceBuffers wall = make_slope(24, 24, LandCoverClass::rock, sun_side_normal, 50.0F);
  const auto tone = [&](float relief) {
    wall.rock_tone = Grid<float>(24, 24, relief);
    return mean(tone_of(wall));
  };
  EXPECT_GT(tone(-0.2F), 0.0);
  EXPECT_LT(tone(-0.2F), 0.12);
  EXPECT_GT(tone(-0.1F), tone(-0.2F) + 0.01);
}

// Level snow with one normal still has forms, in the sun and in the shade, and never becomes pure
// white or one dark tone.
TEST(Tone, SnowHasForms) {
  GuidanceBuffers field = make_slope(160, 120, LandCoverClass::snow, {0.0F, 0.0F, 1.0F}, 8.0F);
  for (const auto [x, y] : test::cells(160, 120))
    field.position_m(x, y) =
        glm::vec3(15.0F * static_cast<float>(x), -15.0F * static_cast<float>(y), 1200.0F);
  const auto spread = [&](LandCoverClass id, float shadow, bool winter) {
    for (LandCoverClass& each : field.land_cover) each = id;
    for (float& s : field.shadow) s = shadow;
    ToneParameters p;
    p.winter = winter;
    const Grid<float> tone = tone_of(field, p);
    const double centre = mean(tone);
    double squares = 0.0;
    for (const float t : tone)
      squares += (static_cast<double>(t) - centre) * (static_cast<double>(t) - centre);
    return std::sqrt(squares / static_cast<double>(tone.size()));
  };
  EXPECT_GT(spread(LandCoverClass::snow, 1.0F, false), 0.065);
  EXPECT_GT(spread(LandCoverClass::glacier, 1.0F, false), 0.06);
  EXPECT_GT(spread(LandCoverClass::snow, 0.0F, false), 0.025) << "shade keeps its forms";
  EXPECT_LT(spread(LandCoverClass::pasture, 1.0F, false), 0.05) << "grass has none of it";
  EXPECT_GT(spread(LandCoverClass::pasture, 1.0F, true), 0.055)
      << "but in winter it is covered by snow";
}

TEST(Tone, SnowShadeIsNeverTheDarkestAndKeepsItsForms) {
  // The deepest shade of two slopes that face away from the sun.
  GuidanceBuffers shade = make_slope(24, 24, LandCoverClass::snow, {0.6F, -0.6F, 0.7F}, 48.0F);
  for (float& s : shade.shadow) s = 0.0F;
  const auto tone = [&](glm::vec3 normal, float sky_view) {
    shade.normal = shade.normal_detail = shade.normal_smooth =
        Grid<glm::vec3>(24, 24, glm::normalize(normal));
    for (float& v : shade.sky_view) v = sky_view;
    return mean(tone_of(shade));
  };
  const double deep = tone({0.5F, -0.7F, 0.5F}, 0.3F);
  EXPECT_GT(deep, 0.0);
  EXPECT_GT(tone({0.5F, -0.7F, 0.5F}, 0.5F), deep + 0.005);
}

// Under a crest of snow a lip is lighter than the snow below it, in places; without anything
// farther behind there is no crest.
TEST(Tone, CornicesHangOverCrestsOfSnow) {
  GuidanceBuffers g = make_slope(400, 40, LandCoverClass::snow, {0.3F, -0.3F, 0.9F}, 25.0F);
  ToneParameters p;
  p.ribs = 0.0;
  const auto shades = [&] {
    const Grid<float> tone = tone_of(g, p);
    int overhead = 0;
    for (int x = 0; x < 400; ++x) overhead += tone(x, 10) > tone(x, 13) + 0.1F ? 1 : 0;
    return overhead;
  };
  const int flat = shades();
  for (int x = 0; x < 400; ++x)
    for (int y = 0; y < 10; ++y) g.depth_m(x, y) = 40000.0F;
  const int crest = shades();
  EXPECT_LT(flat, 5);
  EXPECT_GT(crest, 60);
  EXPECT_LT(crest, 360) << "broken";
}

TEST(Tone, CrestTakesTheToneFromBelow) {
  // A dark rim of two pixels on a lit slope, below a farther range.
  GuidanceBuffers g = make_slope(24, 24, LandCoverClass::pasture, sun_side_normal, 10.0F);
  for (int x = 0; x < 24; ++x) {
    for (int y = 0; y < 10; ++y) g.depth_m(x, y) = 40000.0F;
    for (int y = 10; y < 12; ++y)
      g.normal(x, y) = g.normal_smooth(x, y) = glm::normalize(glm::vec3(0.6F, -0.6F, 0.2F));
  }
  const Grid<float> tone = tone_of(g);
  EXPECT_EQ(tone(12, 10), tone(12, 13));
  EXPECT_GE(tone(12, 11), tone(12, 14));
  // Without the range behind there is no crest, and the rim stays dark.
  for (float& depth : g.depth_m) depth = 20000.0F;
  EXPECT_LT(tone_of(g)(12, 10), tone(12, 10) - 0.3F);
}

TEST(Tone, RibsAreLitFromTheSunsSide) {
  GuidanceBuffers g = make_slope(96, 96, LandCoverClass::scree, glm::vec3(0.0F, 0.3F, 1.0F), 45.0F);
  ToneParameters p;
  p.sun_image_x = 0.6;
  const Grid<float> right = tone_of(g, p);
  p.sun_image_x = -0.6;
  const Grid<float> left = tone_of(g, p);
  p.ribs = 0.0;
  const Grid<float> none = tone_of(g, p);
  // What is light from one side is dark from the other.
  double product = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < none.size(); ++i) {
    product += (right[i] - none[i]) * (left[i] - none[i]);
    squares += (right[i] - none[i]) * (right[i] - none[i]);
  }
  EXPECT_GT(squares / static_cast<double>(none.size()), 0.0003);
  EXPECT_LT(product, -0.2 * squares);
}

TEST(Tone, PartEqualsWhole) {
  for (const double ppu : {1.0, 2.5}) {
    const int width = ppu > 1.0 ? 420 : 260;
    const int height = ppu > 1.0 ? 360 : 200;
    const GuidanceBuffers hills = make_hills(width, height, ppu);
    ToneParameters p;
    p.pixels_per_unit = ppu;
    const Grid<float> whole = tone_of(hills, p);
    const PixelRect kept{width / 2 - 21, height / 2 - 30, width / 2 + 20, height / 2 + 17};
    const PixelRect part = with_margin(kept, tone_margin_px(p), width, height);
    ASSERT_GT(part.x0, 0);
    const Grid<float> tone = make_tone(cut(hills, part), p, {part.x0, part.y0}, silent_progress());
    for (const auto [x, y] : test::cells(kept))
      ASSERT_EQ(tone(x - part.x0, y - part.y0), whole(x, y)) << x << " " << y << " ppu " << ppu;
  }
}

TEST(Tone, OfAPrintLooksAroundInItsWideView) {
  const test::Print print;
  ToneParameters p;
  p.pixels_per_unit = test::print_ppu;
  const Grid<float> whole =
      make_tone(print.near, {print.far, test::print_factor}, p, {0, 0}, silent_progress());
  const PixelRect kept{640, 560, 700, 610};
  const test::Window near = test::window_of(print.near, grown(kept, tone_near_margin_px(p)));
  const test::Window far =
      test::window_of(print.far, wide_rect(grown(kept, tone_margin_px(p)), test::print_factor));
  ASSERT_GT(far.rect.x0, 0);
  ASSERT_GT(far.rect.y0, 0);
  const Grid<float> part = make_tone(
      near.held, {far.held, test::print_factor, {far.rect.x0, far.rect.y0}}, p,
      {near.rect.x0, near.rect.y0}, silent_progress(), moved(kept, -near.rect.x0, -near.rect.y0));
  EXPECT_TRUE(part == test::cut(whole, kept));
  // And it is visually the light from every pixel's own surroundings.
  const Grid<float> own = make_tone(print.near, p, {0, 0}, silent_progress());
  double squares = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) squares += (own[i] - whole[i]) * (own[i] - whole[i]);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(own.size())), 0.02);
}

// A slope at 100 km whose columns of ground lean to the sun and away from it in turn.
GuidanceBuffers make_far_slope(float depth_m) {
  GuidanceBuffers g = make_slope(600, 200, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 20.0F);
  for (float& d : g.depth_m) d = depth_m;
  for (const auto [x, y] : test::cells(g))
    g.normal(x, y) = g.normal_detail(x, y) =
        glm::normalize(glm::vec3(x % 2 == 0 ? -0.25F : 0.25F, 0.0F, 1.0F));
  return g;
}

TEST(Tone, FarRangesLieInPoolsOfLight) {
  const auto means = [](float depth_m) {
    const Grid<float> tone = tone_of(make_far_slope(depth_m));
    float lightest = 0.0F;
    float darkest = 1.0F;
    for (int y = 0; y < tone.height(); ++y)
      for (int x = 0; x + 1 < tone.width(); ++x) {
        const float here = 0.5F * (tone(x, y) + tone(x + 1, y));
        lightest = std::max(lightest, here);
        darkest = std::min(darkest, here);
      }
    return lightest - darkest;
  };
  EXPECT_GT(means(130000.0F), means(20000.0F) + 0.15F);
}

TEST(Tone, FarFlanksInShadeLoseDetail) {
  const Grid<float> far = tone_of(make_far_slope(130000.0F));
  const Grid<float> near = tone_of(make_far_slope(20000.0F));
  float calmest = 1.0F;
  float liveliest = 0.0F;
  for (int y = 0; y < far.height(); ++y)
    for (int x = 0; x + 1 < far.width(); ++x) {
      const float share =
          std::abs(far(x, y) - far(x + 1, y)) / std::abs(near(x, y) - near(x + 1, y));
      calmest = std::min(calmest, share);
      liveliest = std::max(liveliest, share);
    }
  EXPECT_LT(calmest, 0.85F);
  EXPECT_GT(calmest, 0.55F);
  EXPECT_NEAR(liveliest, 1.0F, 0.06F);
}

TEST(Tone, PartOfAFarRangeEqualsWhole) {
  const GuidanceBuffers slope = make_far_slope(100000.0F);
  const Grid<float> whole = tone_of(slope);
  const int margin = tone_margin_px({});
  const PixelRect rect{300, 100, 340, 130};
  const PixelRect held = with_margin(rect, margin, 600, 200);
  const Grid<float> part = make_tone(cut(slope, held), {}, {held.x0, held.y0}, silent_progress());
  for (const auto [x, y] : test::cells(rect))
    ASSERT_EQ(part(x - held.x0, y - held.y0), whole(x, y)) << x << ' ' << y;
}

TEST(Tone, SameBitsForAnyThreads) {
  const GuidanceBuffers hills = make_hills(180, 140);
  const Grid<float> many = tone_of(hills);
  const ThreadLimit one(1);
  EXPECT_EQ(tone_of(hills), many);
}

TEST(Tone, LooksAlikeAtAllResolutions) {
  // Sizes are in units of the sheet: at twice the resolution the mean of four pixels is the pixel
  // of the small picture, except for sampling.
  const GuidanceBuffers small = make_hills(200, 150, 1.0);
  const GuidanceBuffers large = make_hills(400, 300, 2.0);
  ToneParameters p;
  const Grid<float> at_one = tone_of(small, p);
  p.pixels_per_unit = 2.0;
  const Grid<float> at_two = tone_of(large, p);
  double difference = 0.0, spread = 0.0;
  int count = 0;
  const double centre = mean(at_one);
  for (const auto [x, y] : test::cells(200, 150)) {
    if (small.is_sky(small.depth_m.index(x, y))) continue;
    const double fine = 0.25 * (at_two(2 * x, 2 * y) + at_two(2 * x + 1, 2 * y) +
                                at_two(2 * x, 2 * y + 1) + at_two(2 * x + 1, 2 * y + 1));
    difference += std::abs(fine - at_one(x, y));
    spread += std::abs(at_one(x, y) - centre);
    ++count;
  }
  EXPECT_LT(difference / count, 0.25 * spread / count);
}

TEST(Tone, MissingChannelIsAnError) {
  GuidanceBuffers g = make_slope(8, 8, LandCoverClass::rock, {0.0F, 0.0F, 1.0F}, 10.0F);
  g.sky_view = {};
  EXPECT_THROW(tone_of(g), Error);
}

}  // namespace
}  // namespace belvedere
