#include "renderer/exemplar/available_texels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

// 8 × 4 pixels: left half forest, right half rock; tone rises by rows, the fall line points down,
// the top row is sky.
GuidanceBuffers small_view() {
  GuidanceBuffers g;
  g.depth_m = Grid<float>(8, 4, 20000.F);
  g.land_cover = Grid<Class>(8, 4);
  g.tone = g.shadow = g.altitude_m = Grid<float>(8, 4, 0.F);
  g.fall_line = Grid<glm::vec2>(8, 4, {0.F, 1.F});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) {
      g.land_cover(x, y) = x < 4 ? Class::forest : Class::rock;
      g.tone(x, y) = 0.3F * static_cast<float>(y);
      g.shadow(x, y) = x == 0 ? 0.F : 1.F;
      g.altitude_m(x, y) = x < 4 ? 1000.F : 2000.F;
      if (y == 0) {
        g.depth_m(x, y) = std::numeric_limits<float>::infinity();
        g.land_cover(x, y) = Class::sky;
      }
    }
  return g;
}

AvailableTexels coverage_of(const GuidanceBuffers& g) {
  AvailableTexels c;
  add_available(c, g, g.land_cover);
  return c;
}

constexpr auto forest_index = static_cast<std::size_t>(Class::forest);
constexpr auto rock_index = static_cast<std::size_t>(Class::rock);

TEST(AvailableTexels, CountsEachTexelInItsBins) {
  const AvailableTexels c = coverage_of(small_view());
  EXPECT_EQ(c.pixels, 32);
  EXPECT_EQ(c.ground(), 24);
  EXPECT_EQ(c.texels[forest_index], 12);
  // Tones .3 .6 .9 at 20 km; .6 belongs to the bin that it begins.
  EXPECT_EQ(c.by_light[forest_index][1][1], 4);
  EXPECT_EQ(c.by_light[forest_index][3][1], 4);
  EXPECT_EQ(c.by_light[forest_index][4][1], 4);
  EXPECT_EQ(c.by_direction[rock_index][2], 12);
  EXPECT_EQ(c.by_altitude[forest_index][1], 12);
  EXPECT_EQ(c.by_altitude[rock_index][2], 12);
  EXPECT_EQ(c.in_cast_shadow[forest_index], 3);
}

TEST(AvailableTexels, CountsBordersOnOneSurfaceOnly) {
  GuidanceBuffers g = small_view();
  // Three rows, a texel on each side.
  EXPECT_EQ(coverage_of(g).border[forest_index][rock_index], 6);
  EXPECT_EQ(coverage_of(g).border[rock_index][forest_index], 6);
  EXPECT_EQ(coverage_of(g).at_silhouette, 8);  // against the sky
  // The rock moves away behind the forest: no border, but a silhouette of the nearer side.
  for (int y = 1; y < 4; ++y)
    for (int x = 4; x < 8; ++x) g.depth_m(x, y) = 30000.F;
  EXPECT_EQ(coverage_of(g).border[forest_index][rock_index], 0);
  EXPECT_EQ(coverage_of(g).at_silhouette, 8 + 2);
}

TEST(AvailableTexels, AddsUpOverParts) {
  const GuidanceBuffers g = small_view();
  AvailableTexels twice = coverage_of(g);
  add_available(twice, g, g.land_cover);
  EXPECT_EQ(twice.texels[rock_index], 24);
  EXPECT_EQ(twice.pixels, 64);
}

TEST(AvailableTexels, FallLinesFallIntoEightSectors) {
  GuidanceBuffers g = small_view();
  const glm::vec2 towards[8] = {{1, 0},  {.7F, .7F},   {0, 1},  {-.7F, .7F},
                                {-1, 0}, {-.7F, -.7F}, {0, -1}, {.7F, -.7F}};
  for (std::size_t n = 0; n < 8; ++n) {
    for (glm::vec2& d : g.fall_line) d = towards[n];
    EXPECT_EQ(coverage_of(g).by_direction[forest_index][n], 12) << n;
  }
}

TEST(AvailableTexels, NamesWhatIsMissingAndWhatIsTooMuch) {
  NeededTexels demand;
  demand.light[rock_index][0][1] = true;
  demand.light[rock_index][1][1] = true;
  // 32 pixels of 4096²: minimum counts scale with area, and a minimum of one texel per two million
  // becomes one of these 32.
  const double one = 4096.0 * 4096.0 / 32.0;
  const MinTexels floors{.texels = 0,
                         .light = 4 * one,
                         .direction = 0,
                         .shadow = 0,
                         .altitude = 0,
                         .border = 0,
                         .largest_share = 0.5};
  const std::vector<TexelShortage> gaps = find_gaps(coverage_of(small_view()), demand, floors);
  ASSERT_EQ(gaps.size(), 1U);
  EXPECT_EQ(gaps[0].what, "rock, tone 0.0–0.2, 16–28 km");
  EXPECT_EQ(gaps[0].found, 0);
  EXPECT_NEAR(gaps[0].needed, 4.0, 1e-9);
  MinTexels narrow = floors;
  narrow.light = 0;
  narrow.largest_share = 0.4;
  const std::vector<TexelShortage> much = find_gaps(coverage_of(small_view()), demand, narrow);
  ASSERT_EQ(much.size(), 2U);
  EXPECT_TRUE(much[0].too_much);
}

TEST(AvailableTexels, EachFloorIsJudgedAndNamed) {
  NeededTexels demand;
  demand.direction[rock_index][2] = demand.direction[rock_index][4] = true;
  demand.shadow[forest_index] = demand.shadow[rock_index] = true;
  demand.border[forest_index][rock_index] = demand.border[rock_index][forest_index] = true;
  // Of 32 pixels: areas are 4096²/32 times smaller than those of the minimum counts, lines the root
  // of that.
  const double area = 4096.0 * 4096.0 / 32.0;
  const double length = std::sqrt(area);
  MinTexels floors{.texels = 0,
                   .light = 0,
                   .direction = 12 * area,
                   .shadow = 3 * area,
                   .altitude = 0,
                   .border = 5.9 * length,
                   .largest_share = 1.0};
  const auto gaps = [&](const MinTexels& f) {
    std::string names;
    for (const TexelShortage& gap : find_gaps(coverage_of(small_view()), demand, f))
      names += gap.what + "; ";
    return names;
  };
  EXPECT_EQ(gaps(floors), "rock, fall line left; rock, in cast shadow; ");
  floors.direction = 12.5 * area;
  floors.shadow = 3.5 * area;
  floors.border = 6.1 * length;
  EXPECT_EQ(gaps(floors),
            "forest, in cast shadow; border of forest and rock; rock, fall line down; rock, fall "
            "line left; rock, in cast shadow; ");
  floors = {.texels = 0,
            .light = 0,
            .direction = 0,
            .shadow = 0,
            .altitude = 12 * area,
            .border = 0,
            .largest_share = 1.0};
  EXPECT_EQ(gaps(floors), "forest, below 900 m; forest, above 1500 m; ");
  // A needed class without any texels is reported whatever its light; others are not.
  demand.texels[static_cast<std::size_t>(Class::scree)] = demand.texels[rock_index] = true;
  floors = {.texels = 12 * area,
            .light = 0,
            .direction = 0,
            .shadow = 0,
            .altitude = 0,
            .border = 0,
            .largest_share = 1.0};
  EXPECT_EQ(gaps(floors), "scree; ");
}

TEST(AvailableTexels, TheEdgesOfBins) {
  GuidanceBuffers g = small_view();
  for (float& depth : g.depth_m)
    depth = std::isinf(depth) ? depth : 16000.F;  // belongs to the bin that it begins
  for (float& tone : g.tone) tone = 1.F;          // and the lightest to the last bin
  for (float& shadow : g.shadow) shadow = 0.5F;   // half shade is light
  EXPECT_EQ(coverage_of(g).by_light[rock_index][4][1], 12);
  EXPECT_EQ(coverage_of(g).in_cast_shadow[rock_index], 0);
  for (float& depth : g.depth_m) depth = std::isinf(depth) ? depth : 48001.F;
  EXPECT_EQ(coverage_of(g).by_light[rock_index][4][3], 12);
}

TEST(NeededTexels, IsReadStrictly) {
  const NeededTexels demand = parse_needed_texels(
      "[rock]\nlight = [\"1...\", \"....\", \"....\", \"....\", \"...1\"]\nborder = [\"snow\"]\n",
      "d");
  EXPECT_TRUE(demand.light[rock_index][0][0]);
  EXPECT_TRUE(demand.light[rock_index][4][3]);
  EXPECT_FALSE(demand.light[rock_index][1][0]);
  EXPECT_TRUE(demand.texels[rock_index]);
  EXPECT_FALSE(demand.texels[forest_index]);
  EXPECT_TRUE(demand.border[static_cast<std::size_t>(Class::snow)][rock_index]);
  for (const char* wrong : {"[rook]\n", "[rock]\nlight = [\"1\"]\n",
                            "[rock]\nlight = [\"1...\",\"1..x\",\"....\",\"....\",\"....\"]\n",
                            "[rock]\nborder = [\"sky\"]\n", "[rock]\nlicht = 1\n"})
    EXPECT_THROW(parse_needed_texels(wrong, "d"), Error) << wrong;
  // Every class of the built-in table is needed in some light; for a class that it leaves out,
  // another's texels are copied.
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const auto k = static_cast<std::size_t>(info.id);
    if (info.id == Class::sky) continue;
    if (!built_in_needed_texels().texels[k]) {
      EXPECT_NE(info.stand_in, info.id) << info.name;
      continue;
    }
    int asked_for = 0;
    for (const auto& row : built_in_needed_texels().light[k])
      for (const bool flag : row) asked_for += flag ? 1 : 0;
    EXPECT_GT(asked_for, 0) << info.name;
  }
}

TEST(TexelReport, SaysTheSameToPeopleAndMachines) {
  const AvailableTexels c = coverage_of(small_view());
  const std::vector<TexelShortage> gaps = {{"rock, in cast shadow", 3, 5, false}};
  EXPECT_THAT(available_text(c, gaps, true), ::testing::HasSubstr("rock, in cast shadow: 3 of 5"));
  EXPECT_THAT(available_text(c, gaps, false), ::testing::Not(::testing::HasSubstr("3 of 5")));
  EXPECT_THAT(available_text(c, {}, true), ::testing::HasSubstr("All minimum counts are met"));
  EXPECT_THAT(available_json(c, gaps), ::testing::HasSubstr("\"forest\""));
  EXPECT_THAT(available_json(c, gaps), ::testing::HasSubstr("\"wanted\": 5"));
}

}  // namespace
}  // namespace belvedere
