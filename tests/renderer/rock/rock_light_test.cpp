#include "renderer/rock/rock_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tests/renderer/rock/rock_wall.h"

namespace belvedere {
namespace {

using test::limestone;

// A wall that faces north, 60° steep; the view is to the south, so east is on the left of the
// picture.
RockPixel wall_pixel() {
  return {.normal = glm::normalize(glm::vec3(0.0F, 1.0F, 0.6F)),
          .depth_m = 50000.0F,
          .slope_deg = 59.0F,
          .altitude_m = 2000.0F,
          .metres_per_unit = 22.0F,
          .band = 1,
          .scale = 4.0F};
}

struct Flank {
  Spur spur;
  SpurHits hits{};

  // A flank of a large spur that falls to the right (side 1) or left of the picture.
  explicit Flank(std::uint8_t side) {
    spur.grown = true;
    spur.normal = wall_pixel().normal;
    spur.id = 5;
    SpurHit& hit = hits[0];
    hit.spur = &spur;
    hit.side = side;
    hit.across = side != 0 ? 0.3F : -0.3F;
    hit.over_next = 0.4F;
    hit.height = 0.3F;
    hit.slope = {side != 0 ? -1.0F : 1.0F, 0.0F};
  }
};

ToneParameters sun_from(double east) {
  ToneParameters p;
  p.sun_direction = {east, 0.5, 0.5};
  const double length = std::sqrt(east * east + 0.5);
  p.sun_direction /= length;
  return p;
}

float tone_of(const Flank& flank, const ToneParameters& light) {
  return light_rock(limestone(), light, false, wall_pixel(), flank.hits).tone;
}

TEST(RockLight, FlanksThatFaceTheSunAreLit) {
  // The left of the picture is east.
  EXPECT_GT(tone_of(Flank(0), sun_from(0.7)), tone_of(Flank(1), sun_from(0.7)) + 0.25F);
  EXPECT_GT(tone_of(Flank(1), sun_from(-0.7)), tone_of(Flank(0), sun_from(-0.7)) + 0.25F);
  EXPECT_NEAR(tone_of(Flank(0), sun_from(0.7)), tone_of(Flank(1), sun_from(-0.7)), 1e-4F);
}

TEST(RockLight, NoSizeMovesTheToneByMoreThanItsShare) {
  RockPixel p = wall_pixel();
  p.calm_noise = 3.0F;
  const ToneParameters light = sun_from(0.7);
  Flank flank(0);
  const float large = light_rock(limestone(), light, false, p, flank.hits).tone;
  for (const float slope : {-3.0F, -0.5F, 0.5F, 3.0F}) {
    flank.hits[1] = flank.hits[0];
    flank.hits[1].slope = {slope, 0.0F};
    // Its lines and its share of crest and gully are .06 at most.
    EXPECT_NEAR(light_rock(limestone(), light, false, p, flank.hits).tone, large, 0.13F + 0.07F)
        << slope;
  }
}

TEST(RockLight, ACastShadowTakesTheLight) {
  RockPixel p = wall_pixel();
  const Flank flank(0);
  const float lit = light_rock(limestone(), sun_from(0.7), false, p, flank.hits).tone;
  p.shadow = 0.0F;
  const float shaded = light_rock(limestone(), sun_from(0.7), false, p, flank.hits).tone;
  EXPECT_GT(lit, shaded + 0.4F);
  // Shade still has forms.
  EXPECT_GT(std::abs(light_rock(limestone(), sun_from(0.7), false, p, Flank(1).hits).tone - shaded),
            0.02F);
}

// Walls in cast shadow used to look like felt: planes .07 of the tone apart, half of them below the
// darkest paint.
TEST(RockLight, WallsInShadeHavePlanesToo) {
  RockPixel p = wall_pixel();
  p.shadow = 0.0F;
  p.rock = 1.0F;
  p.sky_view = 0.6F;
  for (const double east : {0.7, -0.7, 1.5}) {
    const ToneParameters light = sun_from(east);
    const float left = light_rock(limestone(), light, false, p, Flank(0).hits).tone;
    const float right = light_rock(limestone(), light, false, p, Flank(1).hits).tone;
    EXPECT_GT(std::abs(left - right), 0.16F) << east;
    EXPECT_GT(std::min(left, right), 0.0F) << east << ": paint is left for gullies";
    EXPECT_GT(std::max(left, right), 0.22F) << east;
    EXPECT_LT(std::max(left, right), 0.48F) << east << ": and it is shade";
  }
}

TEST(RockLight, LargeSpursStandInTheSunsWay) {
  const Flank flank(0);
  const ToneParameters light = sun_from(0.7);
  const SunPath way = way_to_sun(limestone(), light, wall_pixel(), flank.hits);
  // The sun is in the east, on the left of the picture, and above.
  EXPECT_LT(way.offset.x, -5.0F);
  EXPECT_GT(way.gained, 0.0F);
  EXPECT_EQ(sun_past(limestone(), way, 0.3F, 0.3F), 1.0F);
  EXPECT_LT(sun_past(limestone(), way, 2.0F, 0.3F), 0.35F);
  EXPECT_GT(sun_past(limestone(), way, 2.0F, 0.3F, 1.0F), 0.6F) << "softer where it is near";
  EXPECT_EQ(sun_past(limestone(), way, -1e9F, 0.3F), 1.0F) << "there is no spur";
  EXPECT_LT(light_rock(limestone(), light, false, wall_pixel(), flank.hits, 0.2F).tone,
            light_rock(limestone(), light, false, wall_pixel(), flank.hits, 1.0F).tone - 0.2F);
  // No sun arrives from behind the wall.
  ToneParameters behind;
  behind.sun_direction = {0.0, -0.8, 0.6};
  EXPECT_EQ(way_to_sun(limestone(), behind, wall_pixel(), flank.hits).gained, 0.0F);
}

TEST(RockLight, RampsHaveALightTreadAndADarkUndercut) {
  Flank flank(0);
  const float plain = tone_of(flank, sun_from(0.7));
  flank.hits.ramp_strength = 1.0F;
  flank.hits.below_ramp = -0.7F;
  EXPECT_GT(tone_of(flank, sun_from(0.7)), plain + 0.03F);
  flank.hits.below_ramp = 0.6F;
  EXPECT_LT(tone_of(flank, sun_from(0.7)), plain - 0.1F);
}

TEST(RockLight, SmallPatchesAreNoPebbles) {
  const auto spread = [](float rock) {
    RockPixel p = wall_pixel();
    p.rock = rock;
    return light_rock(limestone(), sun_from(0.7), false, p, Flank(0).hits).tone -
           light_rock(limestone(), sun_from(0.7), false, p, Flank(1).hits).tone;
  };
  EXPECT_LT(spread(0.1F), 0.5F * spread(1.0F));
  EXPECT_NEAR(spread(0.6F), spread(1.0F), 1e-5F);
}

TEST(RockLight, GulliesAreDarkLines) {
  Flank flank(0);
  flank.hits[0].next_id = 1;
  float darkest = 1.0F;
  // Four pairs of spurs in five have a line between them.
  for (std::uint32_t next = 1; next < 20; ++next) {
    flank.hits[0].next_id = next;
    flank.hits[0].over_next = 0.0F;
    darkest = std::min(darkest, tone_of(flank, sun_from(0.7)));
  }
  flank.hits[0].over_next = 0.5F;
  EXPECT_GT(tone_of(flank, sun_from(0.7)), darkest + 0.2F);
}

TEST(RockLight, BedsOfSandstoneRunThroughTheWallAndThoseOfGraniteDoNotShow) {
  const auto spread = [](const char* name, std::uint32_t id) {
    Flank flank(0);
    flank.spur.id = id;
    RockPixel p = wall_pixel();
    p.bed_show = 1.0F;
    float low = 9.0F;
    float high = -9.0F;
    float at = 0.0F;
    for (int k = 0; k < 400; ++k) {
      p.altitude_m = 2000.0F + 2.0F * static_cast<float>(k);
      const float tone = light_rock(find_rock_kind(name), sun_from(0.7), false, p, flank.hits).tone;
      if (tone < low) at = p.altitude_m;
      low = std::min(low, tone);
      high = std::max(high, tone);
    }
    return std::pair(high - low, at);
  };
  EXPECT_GT(spread("sandstone", 5).first, 0.15F);
  EXPECT_LT(spread("granite", 5).first, 0.08F);
}

TEST(RockLight, SnowLiesOnTreadsInWinterAndTurfInSummer) {
  RockPixel p = wall_pixel();
  p.normal = glm::normalize(glm::vec3(0.0F, 0.4F, 1.0F));
  p.slope_deg = 22.0F;
  p.turf = 0.6F;
  const SpurHits none{};
  const RockLook summer = light_rock(limestone(), sun_from(0.7), false, p, none);
  const RockLook winter = light_rock(limestone(), sun_from(0.7), true, p, none);
  EXPECT_GT(summer.turf, 0.3F);
  EXPECT_EQ(summer.snow, 0.0F);
  EXPECT_GT(winter.snow, 0.5F);
  EXPECT_EQ(winter.turf, 0.0F);
  // A wall sheds both.
  p.normal = glm::normalize(glm::vec3(0.0F, 1.0F, 0.2F));
  p.slope_deg = 79.0F;
  EXPECT_LT(light_rock(limestone(), sun_from(0.7), true, p, none).snow, 0.05F);
  EXPECT_LT(light_rock(limestone(), sun_from(0.7), false, p, none).turf, 0.05F);
}

// Formerly each small spur had its own patch of snow, and walls looked strewn with confetti.
TEST(RockLight, SmallSpursHoldNoSnowOfTheirOwnInWinter) {
  RockPixel p = wall_pixel();
  p.normal = glm::normalize(glm::vec3(0.0F, 1.0F, 0.95F));
  p.slope_deg = 46.0F;
  p.snow = 0.5F;
  const auto snow_at = [&](bool winter, float small_slope) {
    Flank flank(0);
    Spur small = flank.spur;
    small.fall = {0.0F, 1.0F};
    for (const std::size_t size : {1U, 2U}) {
      SpurHit& hit = flank.hits[size];
      hit = flank.hits[0];
      hit.spur = &small;
      hit.slope = {0.0F, size == 2U ? small_slope : 0.0F};
    }
    return light_rock(limestone(), sun_from(0.7), winter, p, flank.hits).snow;
  };
  EXPECT_NE(snow_at(false, -1.5F), snow_at(false, 1.5F)) << "they affect light and old snow";
  EXPECT_EQ(snow_at(true, -1.5F), snow_at(true, 1.5F));
}

TEST(RockLight, GulliesHoldWintersSnowUnlessTheWallIsTooSteep) {
  const auto snow_in = [](bool gully, float slope_deg) {
    Flank flank(0);
    flank.hits[0].over_next = gully ? 0.0F : 1.6F;
    RockPixel p = wall_pixel();
    p.slope_deg = slope_deg;
    p.normal = glm::normalize(glm::vec3(0.0F, std::tan(glm::radians(slope_deg)), 1.0F));
    return light_rock(limestone(), sun_from(0.7), true, p, flank.hits).snow;
  };
  EXPECT_GT(snow_in(true, 52.0F), 0.6F);
  EXPECT_LT(snow_in(false, 52.0F), 0.1F);
  EXPECT_LT(snow_in(true, 76.0F), 0.05F);
}

// Near, rock stands out of the snow in ribs: along crests, and whole where it is very steep.
TEST(RockLight, NearWallsAreBareAlongCrestsInWinter) {
  const auto snow_at = [](float across, float slope_deg) {
    Flank flank(0);
    flank.hits[0].across = across;
    flank.hits[0].part = SpurPart::back;
    RockPixel p = wall_pixel();
    p.metres_per_unit = 6.0F;
    p.slope_deg = slope_deg;
    return light_rock(limestone(), sun_from(0.7), true, p, flank.hits).snow;
  };
  EXPECT_LT(snow_at(0.0F, 44.0F), 0.1F);
  EXPECT_GT(snow_at(0.5F, 40.0F), 0.9F);
  EXPECT_GT(snow_at(0.0F, 30.0F), 0.9F) << "level ground holds snow";
  EXPECT_LT(snow_at(0.5F, 65.0F), 0.1F) << "the steepest walls none";
}

}  // namespace
}  // namespace belvedere
