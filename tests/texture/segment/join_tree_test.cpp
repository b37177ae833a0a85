#include "texture/segment/join_tree.h"

#include <gmock/gmock.h>

namespace belvedere {
namespace {

using ::testing::ElementsAre;

PairWeights on_a_line(const std::vector<double>& positions) {
  PairWeights distance(positions.size());
  for (std::size_t a = 0; a < positions.size(); ++a)
    for (std::size_t b = a + 1; b < positions.size(); ++b)
      distance.set(a, b, std::abs(positions[a] - positions[b]));
  return distance;
}

TEST(JoinTree, NearestFirst) {
  const JoinTree tree = join_pieces(on_a_line({0.0, 1.0, 10.0, 12.0, 30.0}),
                                    std::vector<double>(5, 1.0), {0, 0, 0, 0, 0});
  ASSERT_EQ(tree.joins.size(), 4U);
  EXPECT_THAT(tree.joins[0], ElementsAre(0, 1));
  EXPECT_THAT(tree.joins[1], ElementsAre(2, 3));
  EXPECT_THAT(tree.joins[2], ElementsAre(5, 6));
  EXPECT_THAT(tree.joins[3], ElementsAre(7, 4));
  EXPECT_THAT(cut_tree(tree, 1), ElementsAre(0, 0, 0, 0, 0));
  EXPECT_THAT(cut_tree(tree, 2), ElementsAre(0, 0, 0, 0, 1));
  EXPECT_THAT(cut_tree(tree, 3), ElementsAre(0, 0, 1, 1, 2));
  EXPECT_THAT(cut_nodes(tree, 3), ElementsAre(5, 6, 4));
  EXPECT_THAT(cut_nodes(tree, 1), ElementsAre(8));
  EXPECT_THAT(cut_tree(tree, 5), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(cut_tree(tree, 99), ElementsAre(0, 1, 2, 3, 4));
}

// 1 and 2 are nearest, but are in different groups.
TEST(JoinTree, GroupsAreNodesOfIt) {
  const JoinTree tree =
      join_pieces(on_a_line({0.0, 4.0, 5.0, 9.0}), std::vector<double>(4, 1.0), {0, 0, 1, 1});
  EXPECT_THAT(cut_tree(tree, 2), ElementsAre(0, 0, 1, 1));
}

// 2.0 apart compared with 1.9, but of a sixteenth of the size: a root of a half.
TEST(JoinTree, CrumbsGoFirst) {
  const JoinTree tree =
      join_pieces(on_a_line({0.0, 1.9, 50.0, 52.0}), {16.0, 16.0, 16.0, 1.0}, {0, 0, 0, 0});
  EXPECT_THAT(tree.joins[0], ElementsAre(2, 3));
}

// The mean of two distances, each weighted by its smaller piece: (1 · 3 + 4 · 8) / 5 = 7 to the
// pair, 7.5 to the other.
TEST(JoinTree, MeansCountTheSmallerPiece) {
  PairWeights distance(4);
  distance.set(0, 1, 0.1);
  distance.set(0, 2, 3.0);
  distance.set(1, 2, 8.0);
  distance.set(0, 3, 90.0);
  distance.set(1, 3, 90.0);
  distance.set(2, 3, 7.5);
  const JoinTree tree = join_pieces(distance, {1.0, 4.0, 4.0, 4.0}, {0, 0, 0, 0});
  EXPECT_THAT(tree.joins[1], ElementsAre(4, 2));
  distance.set(2, 3, 6.5);
  EXPECT_THAT(join_pieces(distance, {1.0, 4.0, 4.0, 4.0}, {0, 0, 0, 0}).joins[1],
              ElementsAre(2, 3));
}

TEST(JoinTree, OnePieceHasNoJoins) {
  const JoinTree tree = join_pieces(PairWeights(1), {5.0}, {0});
  EXPECT_TRUE(tree.joins.empty());
  EXPECT_THAT(cut_tree(tree, 3), ElementsAre(0));
}

}  // namespace
}  // namespace belvedere
