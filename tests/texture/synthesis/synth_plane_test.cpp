#include "texture/synthesis/synth_plane.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/texture/synthesis/noise_plane.h"

namespace belvedere::synth {
namespace {

using namespace test;

TEST(Plane, StepsOutOfAPictureLandOnNoClass) {
  const Plane plane = noise_plane({{5, 7}, {9, 3}, {1, 1}}, 2, 5, false);
  for (int p = 0; p < 3; ++p) {
    const Plane::Part& part = plane.parts[static_cast<std::size_t>(p)];
    for (int y = -padding; y < part.height + padding; ++y)
      for (int x = -padding; x < part.width + padding; ++x) {
        const bool inside = x >= 0 && y >= 0 && x < part.width && y < part.height;
        const std::uint32_t at = plane.index(p, x, y);
        ASSERT_EQ(class_of(plane.words[at]) != no_class, inside);
        if (!inside) continue;
        const Plane::Place position = plane.position(at);
        ASSERT_EQ(std::make_tuple(position.part, position.x, position.y), std::make_tuple(p, x, y));
      }
  }
}

TEST(Plane, HalvesByClassAndMean) {
  Plane plane = make_plane({{5, 4}}, 1);
  plane.for_each([&](std::uint32_t at) {
    plane.words[at] = 0x02804020U;
    plane.guides[at] = 77;
  });
  plane.words[plane.index(0, 0, 0)] = 0x01ffffffU;
  plane.words[plane.index(0, 1, 1)] = 0x01ffffffU;  // two of two: the lower class
  plane.words[plane.index(0, 3, 3)] = 0xff123456U;  // excluded: its colour is ignored
  pad(plane);
  const Plane coarse = halve(plane);
  EXPECT_EQ(coarse.parts[0].width, 3);
  EXPECT_EQ(coarse.parts[0].height, 2);
  EXPECT_EQ(class_of(coarse.words[coarse.index(0, 0, 0)]), 1U);
  EXPECT_EQ(coarse.words[coarse.index(0, 2, 1)], 0x02804020U);
  EXPECT_EQ(coarse.words[coarse.index(0, 1, 1)] >> 24, 2U);
  coarse.for_each([&](std::uint32_t at) { EXPECT_EQ(coarse.guides[at], 77); });
}

TEST(Plane, CutsOfCoarserLevelsLieWhereTheFinerOnesDo) {
  Plane plane = noise_plane({{3, 3}, {16, 12}}, 2, 1, false);
  Grid<float> depth(16, 12, 100.F);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) depth(x, y) = x >= 6 ? 300.F : y >= 5 ? 100.F * 1.03F : 100.F;
  depth(12, 3) = 50.F;  // a texel by itself is passed on its other line
  EXPECT_TRUE(add_cuts(depth, 1, 1.04F, plane));
  EXPECT_EQ(plane.cuts[plane.index(1, 5, 2)], cut::right);
  EXPECT_EQ(plane.cuts[plane.index(1, 4, 2)], 0);
  EXPECT_EQ(plane.cuts[plane.index(1, 2, 4)], 0) << "3 % is one surface";
  EXPECT_EQ(plane.cuts[plane.index(1, 12, 3)], cut::right | cut::down);
  const Plane coarse = halve(plane);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_EQ(coarse.cuts[coarse.index(1, x, y)], x == 2 ? cut::right : 0) << x << ' ' << y;
  EXPECT_FALSE(add_cuts(Grid<float>(3, 3, 7.F), 0, 1.04F, plane));
}

}  // namespace
}  // namespace belvedere::synth
