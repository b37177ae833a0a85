#include "texture/synthesis/synth_level.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/texture/synthesis/noise_plane.h"

namespace belvedere::synth {
namespace {

using namespace test;

TEST(Replacement, MovesPiecesWholeAndWithinTheirClass) {
  const Plane exemplars = noise_plane({{150, 120}}, 1, 5, false);
  Plane target = make_plane({{60, 50}}, 1);
  const LevelSettings settings = settings_for_level(0, 1, 100, 1.0);
  // The target is a part of the exemplar, copied from there as one piece.
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 60; ++x) {
      target.words[target.index(0, x, y)] =
          exemplars.words[exemplars.index(0, x + 40, y + 30)] & 0xff000000U;
      target.guides[target.index(0, x, y)] = exemplars.guides[exemplars.index(0, x + 40, y + 30)];
    }
  pad(target);
  LevelState state(settings, {GuideRole{2880}}, classes, exemplars, target, {});
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 60; ++x)
      state.match[target.index(0, x, y)] = exemplars.index(0, x + 40, y + 30);
  recount(state);
  state.pieces.find(target, exemplars, state.match);
  ASSERT_EQ(state.pieces.largest(), 3000U);
  const std::vector<std::uint32_t> before = state.match;
  ASSERT_TRUE(replace_pieces(state, 5, 0));
  int moved = 0;
  target.for_each([&](std::uint32_t at) {
    ASSERT_EQ(class_of(exemplars.words[state.match[at]]), class_of(target.words[at]));
    ASSERT_EQ(exemplars.words[state.match[at]], target.words[at]);
    moved += state.match[at] != before[at] ? 1 : 0;
  });
  // Half of the cells move, with the members that keep their class: a third by chance, fewer here
  // as noise is more expensive than a misfit.
  EXPECT_GT(moved, 3000 / 16);
  EXPECT_LT(moved, 3000 * 3 / 4);
  const TexelRecords kept_along = state.texels;
  LevelState recounted = state;
  recount(recounted);
  EXPECT_TRUE(recounted.texels == kept_along);
  EXPECT_EQ(recounted.bins_actual, state.bins_actual);
  ASSERT_TRUE(replace_pieces(state, 5, 1));
  EXPECT_LT(state.pieces.largest(), 3000U);
  state.settings.copy_cap = 3000;
  EXPECT_FALSE(replace_pieces(state, 5, 2)) << "nothing is over the cap";
}

}  // namespace
}  // namespace belvedere::synth
