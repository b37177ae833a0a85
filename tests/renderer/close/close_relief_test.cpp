#include "renderer/close/close_relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/parallel.h"
#include "tests/grids.h"
#include "tests/renderer/close/close_ground.h"
#include "tests/renderer/paint/hills_print.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

RockRelief close_relief_of(const GuidanceBuffers& g, const RockParameters& p) {
  RockRelief relief = test::bare_relief(g, {0, 0, g.width(), g.height()});
  add_close_relief(relief, g, {g, 1, {0, 0}}, p, {0, 0}, silent_progress());
  return relief;
}

double deviation(const Grid<float>& tone) {
  double squares = 0.0;
  for (const float t : tone) squares += static_cast<double>(t) * t;
  return std::sqrt(squares / static_cast<double>(tone.size()));
}

TEST(CloseRelief, FarGroundForestAndWaterHaveNone) {
  for (const bool far : {true, false}) {
    const GuidanceBuffers g =
        far ? test::make_close_hills(160, 120, 1.0, 25.0, Class::snow, Class::scree)
            : test::make_close_hills(160, 120, 1.0, 6.0, Class::forest, Class::water);
    const RockRelief relief = close_relief_of(g, test::close_parameters(1.0));
    EXPECT_TRUE(relief.land_cover == g.land_cover);
    EXPECT_EQ(deviation(relief.tone), 0.0);
    if (far) {
      EXPECT_TRUE(relief.facet == Grid<std::uint32_t>(160, 120, 0U));
    }
  }
}

// As strong as painters model snow, within the limits of each size, and weaker the farther.
TEST(CloseRelief, SnowHasPlanesInLightAndShade) {
  const auto strength = [](double metres_per_unit) {
    const GuidanceBuffers g =
        test::make_close_hills(200, 160, 1.0, metres_per_unit, Class::snow, Class::snow);
    const RockRelief relief = close_relief_of(g, test::close_parameters(1.0));
    for (const float t : relief.tone)
      EXPECT_LT(std::abs(t), 0.18 + 0.28 + 0.11 + 0.16 + 0.20 + 0.7 * 0.28);
    return deviation(relief.tone);
  };
  const double near = strength(8.0);
  const double middle = strength(19.5);
  EXPECT_GT(near, 0.03);
  EXPECT_LT(near, 0.20);
  EXPECT_NEAR(middle, 0.5 * near, 0.1 * near);
}

// Close relief added to a part alone is the crop of the whole, to the bit.
void expect_part_of(const RockRelief& whole, PixelRect kept, const GuidanceBuffers& g,
                    RockRelief part, bool winter = false) {
  RockParameters p = test::close_parameters(1.0);
  p.winter = winter;
  const test::Window near = test::window_of(g, grown(kept, close_near_margin_px(p)));
  const test::Window far = test::window_of(g, grown(kept, close_margin_px(p)));
  add_close_relief(part, near.held, {far.held, 1, {far.rect.x0, far.rect.y0}}, p,
                   {near.rect.x0, near.rect.y0}, silent_progress(),
                   moved(kept, -near.rect.x0, -near.rect.y0));
  EXPECT_TRUE(part.land_cover == test::cut(whole.land_cover, kept));
  EXPECT_TRUE(part.facet == test::cut(whole.facet, kept));
  EXPECT_TRUE(part.tone == test::cut(whole.tone, kept));
}

TEST(CloseRelief, OfAPartIsThatOfTheWhole) {
  GuidanceBuffers g = test::make_close_hills(960, 420, 1.0, 8.0, Class::snow, Class::scree);
  // In the middle snow lies above scree, and its tongues reach into parts that hold scree alone.
  constexpr int below_snow = 240;
  for (const auto [x, y] : test::cells({300, 0, 600, g.height()}))
    if (!g.is_sky(g.depth_m.index(x, y)))
      g.land_cover(x, y) = y < below_snow ? Class::snow : Class::scree;
  const RockParameters p = test::close_parameters(1.0);
  const RockRelief whole = close_relief_of(g, p);
  const PixelRect tongues{310, below_snow + 4, 590, below_snow + 8};
  const Grid<Class> shown = test::cut(whole.land_cover, tongues);
  ASSERT_GT(std::count(shown.begin(), shown.end(), Class::snow), 50);
  for (const PixelRect kept : {PixelRect{468, 200, 492, 224}, PixelRect{0, 360, 3, 420}, tongues})
    expect_part_of(whole, kept, g, test::bare_relief(g, kept));
}

TEST(CloseRelief, OfAPartBesideAGlacierIsThatOfTheWhole) {
  GuidanceBuffers g =
      test::make_close_hills(760, 420, 1.0, 8.0, Class::glacier, Class::alpine_grass);
  for (const auto [x, y] : test::cells({300, 300, 420, g.height()}))
    if (!g.is_sky(g.depth_m.index(x, y))) g.land_cover(x, y) = Class::scree;
  const RockRelief whole = close_relief_of(g, test::close_parameters(1.0));
  for (const PixelRect kept : {PixelRect{374, 200, 394, 230}, PixelRect{350, 310, 430, 330}})
    expect_part_of(whole, kept, g, test::bare_relief(g, kept));
}

// Below a wall whose gullies hold debris, with grass at its foot.
TEST(CloseRelief, OfAPartWithConesIsThatOfTheWhole) {
  GuidanceBuffers g = test::make_close_hills(900, 420, 1.0, 8.0, Class::scree, Class::alpine_grass);
  for (const auto [x, y] : test::cells(g.width(), 200))
    if (!g.is_sky(g.depth_m.index(x, y))) g.land_cover(x, y) = Class::rock;
  const RockParameters p = test::close_parameters(1.0);
  const auto with_gullies = [](RockRelief relief, glm::ivec2 origin) {
    for (const auto [x, y] : test::cells(relief.land_cover))
      if (relief.land_cover(x, y) == Class::rock && y + origin.y > 185 && (x + origin.x) % 40 < 12)
        relief.land_cover(x, y) = Class::scree;
    return relief;
  };
  const PixelRect all{0, 0, g.width(), g.height()};
  RockRelief whole = with_gullies(test::bare_relief(g, all), {0, 0});
  const Grid<Class> before = whole.land_cover;
  add_close_relief(whole, g, {g, 1, {0, 0}}, p, {0, 0}, silent_progress());
  int covered = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    covered += before[i] == Class::alpine_grass && whole.land_cover[i] == Class::scree ? 1 : 0;
  EXPECT_GT(covered, 500) << "cones lie on grass";
  for (const PixelRect kept : {PixelRect{440, 186, 470, 230}, PixelRect{640, 188, 660, 198},
                               PixelRect{600, 230, 640, 260}}) {
    expect_part_of(whole, kept, g, with_gullies(test::bare_relief(g, kept), {kept.x0, kept.y0}));
  }
}

// Walls that winter has covered, with forest at their foot.
TEST(CloseRelief, OfAPartInWinterIsThatOfTheWhole) {
  GuidanceBuffers g =
      test::make_close_hills(820, 420, 1.0, 8.0, Class::alpine_grass, Class::forest);
  for (const auto [x, y] : test::cells(g.width(), 220))
    if (!g.is_sky(g.depth_m.index(x, y))) g.land_cover(x, y) = Class::rock;
  RockParameters p = test::close_parameters(1.0);
  p.winter = true;
  const auto covered = [](RockRelief relief, glm::ivec2 origin) {
    for (const auto [x, y] : test::cells(relief.land_cover))
      if (relief.land_cover(x, y) == Class::rock && (x + origin.x) % 60 < 40)
        relief.land_cover(x, y) = Class::snow;
    return relief;
  };
  RockRelief whole = covered(test::bare_relief(g, {0, 0, g.width(), g.height()}), {0, 0});
  add_close_relief(whole, g, {g, 1, {0, 0}}, p, {0, 0}, silent_progress());
  double squares = 0.0;
  int count = 0;
  for (int x = 0; x < g.width(); ++x)
    if (whole.land_cover(x, 200) == Class::snow) {
      squares += square(static_cast<double>(whole.tone(x, 200)));
      ++count;
    }
  EXPECT_GT(squares, count * square(0.01)) << "snow on walls has forms";
  for (const PixelRect kept : {PixelRect{380, 190, 440, 216}, PixelRect{396, 250, 424, 300}})
    expect_part_of(whole, kept, g, covered(test::bare_relief(g, kept), {kept.x0, kept.y0}), true);
}

TEST(CloseRelief, SameBitsForAnyThreads) {
  const GuidanceBuffers g =
      test::make_close_hills(200, 160, 1.0, 8.0, Class::alpine_grass, Class::glacier);
  const RockParameters p = test::close_parameters(1.0);
  const ThreadLimit all(2);
  const RockRelief two = close_relief_of(g, p);
  const ThreadLimit limit(1);
  const RockRelief one = close_relief_of(g, p);
  EXPECT_TRUE(one.tone == two.tone);
  EXPECT_TRUE(one.land_cover == two.land_cover);
}

// In winter meadows lie under snow and have its forms; in summer their own.
TEST(CloseRelief, WinterCoversMeadows) {
  const GuidanceBuffers g =
      test::make_close_hills(160, 120, 1.0, 8.0, Class::alpine_grass, Class::alpine_grass);
  RockParameters p = test::close_parameters(1.0);
  const RockRelief summer = close_relief_of(g, p);
  p.winter = true;
  const RockRelief winter = close_relief_of(g, p);
  EXPECT_GT(deviation(winter.tone), 0.01);
  EXPECT_FALSE(winter.tone == summer.tone);
}

}  // namespace
}  // namespace belvedere
