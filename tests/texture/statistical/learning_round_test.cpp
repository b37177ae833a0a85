#include "texture/statistical/learning_round.h"

#include <gtest/gtest.h>

#include "tests/texture/statistical/texture_crops.h"
#include "texture/statistical/learn_texture.h"

namespace belvedere {
namespace {

TEST(LearningRound, TheCropItselfIsNoDistanceAwayAndStrangersAre) {
  const Grid<Rgb8> crop = test::striped_crop(64, 64, 8);
  const BandSpace bands = find_bands(crop, {});
  const BandPicture example = to_bands(crop, bands, {});
  std::vector<CliqueCandidate> candidates = make_candidates(example, bands, candidate_types(0, 4));
  const LearningRound same = evaluate_candidates(candidates, example, bands);
  EXPECT_EQ(same.worst, candidates.size());
  EXPECT_EQ(same.told.types, 0);
  EXPECT_EQ(same.told.held_out_l1, 0.0);

  const BandPicture turned = to_bands(test::meadow_crop(64, 64), bands, {});
  const LearningRound other = evaluate_candidates(candidates, turned, bands);
  ASSERT_LT(other.worst, candidates.size());
  EXPECT_GT(other.told.worst_l2, .1);
  // Included types are not tested again.
  candidates[other.worst].in = true;
  const LearningRound next = evaluate_candidates(candidates, turned, bands);
  EXPECT_NE(next.worst, other.worst);
  EXPECT_EQ(next.told.types, 1);
  EXPECT_LE(next.told.worst_l2, other.told.worst_l2);
}

}  // namespace
}  // namespace belvedere
