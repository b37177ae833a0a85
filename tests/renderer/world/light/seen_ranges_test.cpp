#include "renderer/world/light/seen_ranges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "renderer/trace/sun.h"
#include "tests/renderer/trace/synthetic_ground.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using test::all_meadow;
using test::make_world;
using test::small_scene;
using test::small_scene_text;
using test::SyntheticWorld;
using testing::HasSubstr;

// Two cones of 1500 m on a plain, 9 km apart from west to east; the camera is north of them and
// looks south, so that it sees the sides that a sun in the south leaves dark.
class TwoCones : public testing::Test {
 protected:
  SyntheticWorld world_ = make_world(
      600, 400,
      [](double x, double y) {
        const auto cone = [&](double cx) {
          return std::max(0.0, 1500.0 - 0.6 * std::hypot(x - cx, y - 5000.0));
        };
        return std::max(cone(4500.0), cone(13500.0));
      },
      all_meadow);
  std::unique_ptr<const Camera> camera_;
  View view_;

  TwoCones() {
    CameraParameters p;
    p.width = 160;
    p.height = 90;
    p.eye = {659000.0, 5328000.0, 5000.0};
    p.azimuth_deg = 180.0;
    p.pitch_deg = -18.0;
    p.field_of_view_deg = 75.0;
    camera_ = make_camera(p);
    view_.camera = p;
    set_sun(180.0, 20.0);  // low enough that more than the middle of the seen sides is turned away
  }
  void set_sun(double azimuth_deg, double altitude_deg) {
    view_.sun = {azimuth_deg, altitude_deg};
    view_.sun_direction = sun_direction(view_.sun);
  }
  std::vector<SeenSlope> slopes() const {
    return see_slopes(world_.terrain, 1.0, *world_.tracer, *camera_, 1);
  }
  std::vector<SeenRange> lit_ranges() const {
    const std::vector<SeenSlope> seen = slopes();
    std::vector<SeenRange> ranges = find_ranges(seen);
    light_ranges(ranges, seen, *world_.tracer, view_.sun_direction, nullptr);
    return ranges;
  }
};

TEST_F(TwoCones, EachIsARange) {
  const std::vector<SeenRange> ranges = lit_ranges();
  ASSERT_EQ(ranges.size(), 2U);
  for (const SeenRange& range : ranges) {
    const double cone = range.summit.x < 659000.0 ? 654500.0 : 663500.0;
    EXPECT_LT(glm::length(range.summit - glm::dvec2(cone, 5315000.0)), 400.0);
    EXPECT_NEAR(range.altitude_m, 1500.0, 150.0);
    EXPECT_GT(range.centre.y, 5315000.0) << "the side that is seen";
    EXPECT_NEAR(range.lit + range.cast + range.away, 1.0, 1e-12);
  }
  EXPECT_NEAR(ranges[0].share + ranges[1].share, 1.0, 1e-12);
}

TEST_F(TwoCones, StandInShadeWithTheSunBehindThem) {
  for (const SeenRange& range : lit_ranges()) {
    EXPECT_TRUE(range.in_shade());
    EXPECT_GT(range.away, 0.4);
  }
  set_sun(340.0, 35.0);
  for (const SeenRange& range : lit_ranges()) {
    EXPECT_FALSE(range.in_shade());
    EXPECT_GT(range.lit, 0.8);
  }
}

TEST_F(TwoCones, TheProposalTurnsThemToTheLightAndLoads) {
  const LoadedScene scene = small_scene();
  const std::vector<SeenSlope> seen = slopes();
  const std::vector<ProposedLight> proposed =
      propose_light(scene, *world_.terrain.dem, view_, seen, *world_.tracer);
  ASSERT_EQ(proposed.size(), 2U);
  for (const ProposedLight& one : proposed) {
    EXPECT_LT(one.lit_before, 0.4);
    EXPECT_GT(one.lit_after, one.lit_before + 0.2);
  }
  const std::string text = proposed_light_text(proposed);
  const LoadedScene again = parse_scene(small_scene_text + text, "small.toml", ".", {});
  ASSERT_EQ(again.scene.light_regions.size(), 2U);
  EXPECT_EQ(again.scene.light_regions[0].turn_deg, proposed[0].region.turn_deg);
  EXPECT_EQ(again.scene.light_regions[1].position, proposed[1].region.position);
  EXPECT_EQ(again.scene.light_regions[1].radius_m, proposed[1].region.radius_m);
  // A turned region needs no further one.
  EXPECT_TRUE(propose_light(again, *world_.terrain.dem, view_, seen, *world_.tracer).empty());
  EXPECT_EQ(
      proposed_light_text(propose_light(scene, *world_.terrain.dem, view_, seen, *world_.tracer)),
      text)
      << "each time the same";
}

TEST_F(TwoCones, NothingIsProposedWhereTheLightIsGood) {
  set_sun(320.0, 35.0);
  const std::vector<ProposedLight> none =
      propose_light(small_scene(), *world_.terrain.dem, view_, slopes(), *world_.tracer);
  EXPECT_TRUE(none.empty());
  EXPECT_THAT(proposed_light_text(none), HasSubstr("# No range"));
}

// A high wall north of a cone, outside the picture, casts its shadow on it.
TEST(SeenRanges, ToldFromTurnedAwayIsWhatLiesInCastShadow) {
  const auto cone_behind_wall = [](double wall) {
    return make_world(
        300, 400,
        [wall](double x, double y) {
          if (y > 1500.0 && y < 1800.0) return wall;
          return std::max(0.0, 900.0 - 0.5 * std::hypot(x - 4500.0, y - 5000.0));
        },
        all_meadow);
  };
  CameraParameters p;
  p.width = 96;
  p.height = 64;
  p.eye = {654500.0, 5318000.0, 9000.0};
  p.azimuth_deg = 180.0;
  p.pitch_deg = -70.0;
  const auto camera = make_camera(p);
  const auto shares = [&](double wall) {
    const SyntheticWorld world = cone_behind_wall(wall);
    const std::vector<SeenSlope> seen = see_slopes(world.terrain, 1.0, *world.tracer, *camera, 1);
    std::vector<SeenRange> ranges = find_ranges(seen);
    light_ranges(ranges, seen, *world.tracer, sun_direction({0.0, 30.0}), nullptr);
    double lit = 0.0;
    double cast = 0.0;
    for (const SeenRange& range : ranges) {
      if (std::abs(range.summit.y - 5315000.0) > 1000.0) continue;
      lit = range.lit;
      cast = range.cast;
    }
    return glm::dvec2(lit, cast);
  };
  EXPECT_GT(shares(0.0).x, 0.4);
  EXPECT_EQ(shares(0.0).y, 0.0);
  EXPECT_GT(shares(3000.0).y, shares(0.0).x - 0.15) << "what was lit lies in its shadow";
}

}  // namespace
}  // namespace belvedere
