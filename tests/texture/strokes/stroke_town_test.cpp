#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// Level ground seen from above at 20 m per pixel, all of one class, 900 m high.
Picture level(LandCoverClass id, int width = 240, int height = 200) {
  Picture p = plain_picture(id, width, height);
  p.guidance.depth_m = Grid<float>(width, height, 20000.F);
  p.guidance.fall_line = Grid<glm::vec2>(width, height, glm::vec2(0.F));
  p.guidance.footprint_m = Grid<float>(width, height, 20.F);
  p.guidance.slope_deg = Grid<float>(width, height, 1.F);
  p.guidance.built = Grid<float>(width, height, 0.6F);
  p.guidance.grain = Grid<glm::vec2>(width, height, glm::vec2(1.F, 0.F));
  for (const auto [x, y] : test::cells(width, height))
    p.guidance.position_m(x, y) =
        glm::vec3(20.F * static_cast<float>(x), -20.F * static_cast<float>(y), 900.F);
  p.ground.darker = p.ground.lighter = p.ground.colour;
  p.ground.tree_density = Grid<float>(width, height, 0.F);
  return p;
}

bool is_wall(const Stroke& s) {
  return s.gate == StrokeGate::surface && s.alpha == 0.95F && s.colour.y > 0.75F &&
         s.colour.z > 0.65F;
}
bool is_spire(const Stroke& s) {
  return s.gate == StrokeGate::upright && s.end_width < 0.2F * s.start_width;
}

// How closely the houses within `around` pixels of a position follow rows of this pitch, 0…1;
// nothing with hardly any houses.
std::optional<double> rowed(const std::vector<Stroke>& strokes, bool vertical, double pitch_px,
                            glm::vec2 position, float around) {
  std::complex<double> sum = 0.0;
  int count = 0;
  for (const Stroke& s : strokes) {
    if (!is_wall(s)) continue;
    const glm::vec2 centre = 0.5F * (s.points[0] + s.points[1]);
    if (std::max(std::abs(centre.x - position.x), std::abs(centre.y - position.y)) > around)
      continue;
    sum +=
        std::polar(1.0, 6.283185 * static_cast<double>(vertical ? centre.x : centre.y) / pitch_px);
    ++count;
  }
  constexpr int enough = 8;
  return count < enough ? std::nullopt : std::optional(std::abs(sum) / count);
}
// The mean over the picture, for positions with this spacing.
double rowed_near(const std::vector<Stroke>& strokes, bool vertical, double pitch_px) {
  constexpr float around = 9.F;  // two plots in each direction
  double sum = 0.0;
  int count = 0;
  for (float y = around; y < 200.F - around; y += around)
    for (float x = around; x < 240.F - around; x += around)
      if (const std::optional<double> here = rowed(strokes, vertical, pitch_px, {x, y}, around))
        sum += *here, ++count;
  EXPECT_GT(count, 100);
  return sum / std::max(1, count);
}

TEST(Towns, HousesStandInRowsAlongTheGrain) {
  Picture p = level(settlement);
  // 2^6.5 m hold 3 units of 20 m and a garden.
  const double pitch_px = std::exp2(6.5) / 20.0;
  const auto strokes = [&] { return town_strokes(p.scene()); };
  EXPECT_GT(rowed_near(strokes(), false, pitch_px), 0.45);
  for (glm::vec2& grain : p.guidance.grain) grain = {0.F, 1.F};  // 45°
  EXPECT_LT(rowed_near(strokes(), false, pitch_px), 0.38);
}

TEST(Towns, AreNoChessboards) {
  const Picture p = level(settlement);
  const double pitch_px = std::exp2(6.5) / 20.0;
  const std::vector<Stroke> strokes = town_strokes(p.scene());
  EXPECT_LT(rowed(strokes, false, pitch_px, {120.F, 100.F}, 120.F).value(), 0.3) << "rows bend";
  EXPECT_LT(rowed(strokes, true, pitch_px, {120.F, 100.F}, 120.F).value(), 0.3)
      << "houses of many rows form no line";
  EXPECT_LT(rowed_near(strokes, true, pitch_px), 0.45) << "nor those of two streets";
}

TEST(Towns, HaveNoTwoHousesOnOnePlot) {
  Picture p = level(settlement);
  for (const auto [x, y] : test::cells(240, 200))
    p.guidance.built(x, y) = 0.45F - 0.0005F * std::hypot(x - 120.F, y - 100.F);  // one church
  std::vector<glm::vec2> feet;
  for (const Stroke& s : town_strokes(p.scene()))
    if (is_wall(s)) feet.push_back(0.5F * (s.points[0] + s.points[1]));
  int too_near = 0;
  for (std::size_t a = 0; a < feet.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      too_near += std::hypot(feet[a].x - feet[b].x, feet[a].y - feet[b].y) < 1.5F ? 1 : 0;
  EXPECT_LT(too_near, 12);  // for churches at random positions
}

TEST(Towns, AreDenserAndLargerInTheirMiddle) {
  const auto total = [&](float built) {
    Picture p = level(settlement);
    for (float& b : p.guidance.built) b = built;
    double width = 0.0;
    int count = 0;
    for (const Stroke& s : town_strokes(p.scene())) {
      if (!is_wall(s)) continue;
      width += std::abs(s.points[1].x - s.points[0].x);
      ++count;
    }
    return std::pair(count, width / count);
  };
  const auto [few, small] = total(0.1F);
  const auto [many, large] = total(0.8F);
  EXPECT_GT(many, 1.4 * few);
  EXPECT_GT(large, 1.1 * small);
}

// Where villages are drawn house by house most roofs are a grey rose, and red ones stand in groups.
TEST(Towns, RedRoofsAreAccentsNearTheViewer) {
  const auto red_share = [&](float metres) {
    Picture p = level(settlement);
    for (float& f : p.guidance.footprint_m) f = metres;
    for (glm::vec3& at : p.guidance.position_m)
      at = {at.x * metres / 20.F, at.y * metres / 20.F, at.z};
    int red = 0;
    int all = 0;
    for (const Stroke& s : town_strokes(p.scene())) {
      if (s.gate != StrokeGate::surface || s.alpha != 0.95F || is_wall(s)) continue;
      red += s.colour.x > 1.6F * s.colour.y ? 1 : 0;
      ++all;
    }
    return static_cast<double>(red) / all;
  };
  const double far = red_share(30.F);
  const double near = red_share(8.F);
  EXPECT_GT(far, 0.5);
  EXPECT_LT(near, 0.5 * far);
  EXPECT_GT(near, 0.1 * far);
}

// Lanes run between the rows of villages drawn house by house, and their parts meet.
TEST(Towns, LanesRunBetweenRowsOfHouses) {
  const auto lanes = [&](float metres, float built) {
    Picture p = level(settlement);
    for (float& f : p.guidance.footprint_m) f = metres;
    for (float& b : p.guidance.built) b = built;
    for (glm::vec3& at : p.guidance.position_m)
      at = {at.x * metres / 20.F, at.y * metres / 20.F, at.z};
    std::vector<Stroke> found = town_strokes(p.scene());
    std::erase_if(found, [](const Stroke& s) { return s.gate != StrokeGate::same_class; });
    return found;
  };
  EXPECT_TRUE(lanes(30.F, 0.6F).empty()) << "far away";
  EXPECT_TRUE(lanes(8.F, 0.03F).empty()) << "single houses";
  const std::vector<Stroke> near = lanes(8.F, 0.6F);
  ASSERT_GT(near.size(), 500U);
  std::size_t joined = 0;
  for (const Stroke& one : near)
    joined += std::any_of(near.begin(), near.end(), [&](const Stroke& other) {
      return &one != &other && std::hypot(one.points[1].x - other.points[0].x,
                                          one.points[1].y - other.points[0].y) < 2.F;
    });
  EXPECT_GT(static_cast<double>(joined), 0.8 * static_cast<double>(near.size()));
}

TEST(Towns, EveryVillageHasItsChurchInItsMiddle) {
  Picture p = level(valley_floor);
  for (const glm::ivec2 centre : {glm::ivec2(60, 60), glm::ivec2(170, 130)})
    for (int y = -12; y <= 12; ++y)
      for (int x = -12; x <= 12; ++x) {
        const float away = std::hypot(static_cast<float>(x), static_cast<float>(y));
        if (away > 12.F) continue;
        p.guidance.land_cover(centre.x + x, centre.y + y) = settlement;
        p.guidance.built(centre.x + x, centre.y + y) = 0.35F - 0.02F * away;
      }
  std::vector<glm::vec2> spires;
  for (const Stroke& s : town_strokes(p.scene()))
    if (is_spire(s)) spires.push_back(s.points[0]);
  ASSERT_EQ(spires.size(), 2U);
  EXPECT_NEAR(spires[0].x, 60.F, 5.F);
  EXPECT_NEAR(spires[0].y, 60.F, 8.F);
  EXPECT_NEAR(spires[1].x, 170.F, 5.F);
}

TEST(Towns, OfTwoMiddlesInOneVillageTheDenserHasTheChurch) {
  Picture p = level(valley_floor);
  // Two quarters 12 px apart, the right one denser; a third 40 px away.
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 240; ++x) {
      const auto cone = [&](float at_x, float top) {
        return top - 0.02F * std::hypot(static_cast<float>(x) - at_x, static_cast<float>(y) - 61.F);
      };
      const float built = std::max({cone(61.F, 0.30F), cone(73.F, 0.35F), cone(113.F, 0.25F)});
      if (built < 0.05F) continue;
      p.guidance.land_cover(x, y) = settlement;
      p.guidance.built(x, y) = built;
    }
  std::vector<float> spires;
  for (const Stroke& s : town_strokes(p.scene()))
    if (is_spire(s)) spires.push_back(s.points[0].x);
  ASSERT_EQ(spires.size(), 2U);
  EXPECT_NEAR(spires[0], 73.F, 4.F);
  EXPECT_NEAR(spires[1], 113.F, 4.F);
}

TEST(Towns, FarmsAreFewAndOnGentleLowGround) {
  const auto count = [&](const Picture& p) {
    int walls = 0;
    for (const Stroke& s : grow_strokes("farms", p.scene())) walls += is_wall(s) ? 1 : 0;
    return walls;
  };
  Picture p = level(valley_floor, 400, 400);
  EXPECT_GT(count(p), 20);
  EXPECT_LT(count(p), 400 * 400 / 300);
  Picture steep = p;
  for (float& slope : steep.guidance.slope_deg) slope = 25.F;
  EXPECT_EQ(count(steep), 0);
  Picture high = p;
  for (glm::vec3& position : high.guidance.position_m) position.z = 1600.F;
  EXPECT_EQ(count(high), 0);
  EXPECT_EQ(count(level(forest, 400, 400)), 0);
}

}  // namespace
}  // namespace belvedere
