#include "texture/synthesis/match_field.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace belvedere {
namespace {

TEST(MatchField, ReplaysAnyLayerOfItsExemplars) {
  MatchField field(3, 1);
  field(0, 0) = {0, 1, 0};
  field(1, 0) = {1, 0, 2};
  Grid<float> first(2, 1);
  Grid<float> second(1, 3);
  first(1, 0) = 0.25F;
  second(0, 2) = -7.5F;
  const Grid<float> out = replay<float>(field, {&first, &second}, Grid<float>(3, 1, 99.0F));
  EXPECT_EQ(out(0, 0), 0.25F);
  EXPECT_EQ(out(1, 0), -7.5F);
  EXPECT_EQ(out(2, 0), 99.0F) << "a pixel without match takes the value of `missing`";
  EXPECT_EQ(replay<float>(field, {&first, &second}, Grid<float>())(2, 0), 0.0F);
}

TEST(MatchField, RefusesMatchesOutsideTheLayers) {
  MatchField field(1, 1);
  Grid<int> layer(2, 2);
  field(0, 0) = {0, 2, 0};
  EXPECT_THROW(replay<int>(field, {&layer}, Grid<int>()), Error);
  field(0, 0) = {1, 0, 0};
  EXPECT_THROW(replay<int>(field, {&layer}, Grid<int>()), Error);
  field(0, 0) = {0, 1, 1};
  EXPECT_THROW(replay<int>(field, {&layer}, Grid<int>(3, 3)), Error) << "`missing` of another size";
}

}  // namespace
}  // namespace belvedere
