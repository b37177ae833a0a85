#include "base/masks/polygon.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

TEST(Polygon, ARingWithinARingIsAHole) {
  const std::vector<std::vector<glm::dvec2>> rings{
      {{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{4, 4}, {4, 6}, {6, 6}, {6, 4}}, {}};
  EXPECT_TRUE(encloses(rings, {1, 5}));
  EXPECT_TRUE(encloses(rings, {9, 9}));
  EXPECT_FALSE(encloses(rings, {5, 5}));
  EXPECT_FALSE(encloses(rings, {11, 5}));
  EXPECT_FALSE(encloses(rings, {-1, 10}));
  EXPECT_FALSE(encloses({}, {0, 0}));
}

TEST(Polygon, WhatLiesOnAnEdgeIsInOneOfTheAreasBesideIt) {
  const std::vector<std::vector<glm::dvec2>> left{{{0, 0}, {5, 0}, {5, 10}, {0, 10}}};
  const std::vector<std::vector<glm::dvec2>> right{{{5, 0}, {10, 0}, {10, 10}, {5, 10}}};
  for (double y = 0.5; y < 10.0; y += 0.5)
    EXPECT_NE(encloses(left, {5, y}), encloses(right, {5, y})) << y;
}

TEST(Polygon, AreasHaveASignByTheWayTheyRun) {
  EXPECT_DOUBLE_EQ(signed_area({{1e6, 1e6}, {1e6 + 4, 1e6}, {1e6 + 4, 1e6 + 3}}), 6.0);
  EXPECT_DOUBLE_EQ(signed_area({{0, 0}, {0, 2}, {2, 2}, {2, 0}}), -4.0);
  EXPECT_EQ(signed_area({}), 0.0);
}

}  // namespace
}  // namespace belvedere
