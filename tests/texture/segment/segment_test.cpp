#include "texture/segment/segment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/grids.h"
#include "texture/segment/segment_figures.h"

namespace belvedere {
namespace {

// Sky above, dark forest to the left, meadow to the right, all with grain: clearly three things.
int part(int x, int y) { return y < 60 ? 0 : (x < 80 + y / 8 ? 1 : 2); }
Grid<glm::vec3> landscape(int width, int height) {
  const glm::vec3 colours[3] = {{.8F, -.02F, -.06F}, {.35F, -.03F, .03F}, {.65F, -.08F, .1F}};
  Grid<glm::vec3> out(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    const int p = part(x, y);
    out(x, y) = colours[p];
    out(x, y).x +=
        (p == 0 ? .0003F : .0012F) * static_cast<float>(random_index(100, 3, x / 2, y / 2));
  }
  return out;
}

TEST(Segment, ThreeThingsAreThreeGroups) {
  const Grid<glm::vec3> picture = landscape(200, 150);
  const Segments segments = find_segments(picture);
  const Partition groups = cut_tree(
      join_pieces(segments.distance, segments.pixels, group_pieces(segments, usual_theta)), 3);
  Grid<std::uint16_t> found(200, 150);
  Grid<std::uint8_t> truth(200, 150);
  for (const auto [x, y] : test::cells(200, 150)) {
    found(x, y) = groups[segments.pieces.of(x, y)];
    truth(x, y) = static_cast<std::uint8_t>(part(x, y));
  }
  EXPECT_GT(segment_agreement(found, truth).one_to_one, 0.97);
}

TEST(Segment, LargerThetasMakeFewerGroups) {
  const Segments segments = find_segments(landscape(200, 150));
  const auto groups = [&](double theta) {
    const Partition found = group_pieces(segments, theta);
    return *std::max_element(found.begin(), found.end()) + 1;
  };
  EXPECT_GT(groups(0.2), groups(1.1));
  EXPECT_GE(groups(1.1), groups(3.0));
  EXPECT_EQ(groups(100.0), 1);
}

TEST(Segment, SameForAnyThreads) {
  const auto made = [](int threads) {
    const ThreadLimit limit(threads);
    const Segments segments = find_segments(landscape(160, 120));
    return std::pair(
        segments.pieces.of,
        join_pieces(segments.distance, segments.pixels, group_pieces(segments, usual_theta)).joins);
  };
  EXPECT_EQ(made(1), made(2));
}

TEST(Segment, OneColourIsOneGroupAndTinyPicturesAreRefused) {
  const Segments flat =
      find_segments(Grid<glm::vec3>(64, 64, glm::vec3(.5F, 0, 0)),
                    {.pieces = {}, .distance = {.down_gain = 0.0, .across_gain = 0.0}});
  for (const std::uint16_t group : group_pieces(flat, usual_theta)) EXPECT_EQ(group, 0);
  EXPECT_THROW(find_segments(Grid<glm::vec3>(31, 200, glm::vec3(.5F))), Error);
}

TEST(Segment, ReducesToAboutTwoHundredThousandPixels) {
  EXPECT_EQ(segment_reduction(512, 384), 1);
  EXPECT_EQ(segment_reduction(1732, 1155), 3);
  EXPECT_EQ(segment_reduction(20000, 10000), 32);
  Grid<glm::vec3> picture(5, 3);
  for (std::size_t i = 0; i < picture.size(); ++i) picture[i] = glm::vec3(static_cast<float>(i));
  const Grid<glm::vec3> reduced = reduce_blocks(picture, 2);
  ASSERT_EQ(reduced.width(), 3);
  ASSERT_EQ(reduced.height(), 2);
  EXPECT_FLOAT_EQ(reduced(0, 0).x, (0 + 1 + 5 + 6) / 4.F);
  EXPECT_FLOAT_EQ(reduced(2, 0).x, (4 + 9) / 2.F);
  EXPECT_FLOAT_EQ(reduced(2, 1).x, 14.F);
}

// A slanted border, found in blocks of three pixels, is at its true position.
TEST(Segment, EnlargedBordersFollowThePicture) {
  constexpr int side = 99;
  const auto dark = [](int x, int y) { return 2 * x + y < 150; };
  const Grid<glm::vec3> picture = test::grid_of<glm::vec3>(
      side, side, [&](int x, int y) { return glm::vec3(dark(x, y) ? .2F : .8F); });
  const Grid<glm::vec3> reduced = reduce_blocks(picture, 3);
  Grid<std::uint16_t> of(reduced.width(), reduced.height());
  for (std::size_t i = 0; i < of.size(); ++i) of[i] = reduced[i].x < .5F ? 7 : 4;
  const Grid<std::uint16_t> whole = enlarge_pieces(of, picture, 3);
  int wrong = 0;
  for (const auto [x, y] : test::cells(side, side))
    wrong += whole(x, y) == (dark(x, y) ? 7 : 4) ? 0 : 1;
  EXPECT_LE(wrong, 6);
  EXPECT_EQ(enlarge_pieces(of, reduced, 1), of);
}

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

// Vertical bands of 20 pixels, each a piece of one colour.
struct Bands {
  Grid<glm::vec3> picture;
  Superpixels pieces;
};
Bands make_bands(const std::vector<glm::vec3>& colours) {
  const int width = 20 * static_cast<int>(colours.size());
  Bands out{Grid<glm::vec3>(width, 40), {Grid<std::uint16_t>(width, 40), colours.size()}};
  for (const auto [x, y] : test::cells(width, 40)) {
    out.picture(x, y) = colours[static_cast<std::size_t>(x / 20)];
    out.pieces.of(x, y) = static_cast<std::uint16_t>(x / 20);
  }
  return out;
}

// No blur, no texture, no position: the rest is known.
constexpr PieceDistanceParameters plain = {.colour_blur_px = 0.0,
                                           .lightness_gain = 10.0,
                                           .colour_gain = 40.0,
                                           .texture_gain = 0.0,
                                           .down_gain = 0.0,
                                           .across_gain = 0.0,
                                           .border_blur_px = 0.0,
                                           .way_gain = 0.0,
                                           .neighbour_gain = 0.0};

TEST(PieceFeatures, FlatColoursAreAsFarApartAsTheyAre) {
  const Bands bands = make_bands({{.5F, 0.F, 0.F}, {.8F, 0.F, 0.F}, {.5F, .1F, 0.F}});
  const PieceFeatures features = measure_pieces(bands.picture, bands.pieces, plain);
  EXPECT_NEAR(features.distance(0, 1), 3.0, 1e-5);
  EXPECT_NEAR(features.distance(0, 2), 4.0, 1e-5);
  EXPECT_NEAR(features.distance(1, 2), 5.0, 1e-5);
  EXPECT_EQ(features.pixels, (std::vector<double>{800, 800, 800}));
}

TEST(PieceFeatures, PlaceCountsByItsGain) {
  const Bands bands = make_bands({glm::vec3(.5F), glm::vec3(.5F)});
  PieceDistanceParameters parameters = plain;
  parameters.across_gain = 0.6;
  EXPECT_NEAR(measure_pieces(bands.picture, bands.pieces, parameters).distance(0, 1), 0.3, 1e-12);
}

TEST(PieceFeatures, TextureOfEqualColourTellsPiecesApartAndItsDirection) {
  Bands bands = make_bands(
      {glm::vec3(.5F, 0, 0), glm::vec3(.5F, 0, 0), glm::vec3(.5F, 0, 0), glm::vec3(.5F, 0, 0)});
  for (const auto [x, y] : test::cells({20, 0, 60, 40}))
    bands.picture(x, y).x +=
        (x < 40 ? y : x) / 2 % 2 == 0 ? .1F : -.1F;  // lines along rows, then columns
  PieceDistanceParameters parameters = plain;
  parameters.texture_gain = 1.0;
  parameters.lightness_gain = 0.0;
  const PieceFeatures features = measure_pieces(bands.picture, bands.pieces, parameters);
  EXPECT_GT(features.distance(0, 1), 1.0);
  EXPECT_GT(features.distance(1, 2), 1.0);
}

// Equal colours, one beyond a bar of another: the path crosses two borders.
TEST(PieceFeatures, ContoursBetweenPartThem) {
  const Bands bands = make_bands({{.5F, 0.F, 0.F}, {.6F, 0.F, 0.F}, {.5F, 0.F, 0.F}});
  PieceDistanceParameters parameters = plain;
  parameters.way_gain = 0.5;
  parameters.way_free = 0.2;
  const PieceFeatures features = measure_pieces(bands.picture, bands.pieces, parameters);
  // Each border is a step of 10 · .1 = 1, minus the free part.
  EXPECT_NEAR(piece_distances(bands.picture, bands.pieces, features, parameters)(0, 2),
              0.5 * 2.0 * 0.8, 1e-5);
  parameters.way_max = 1.0;
  EXPECT_NEAR(piece_distances(bands.picture, bands.pieces, features, parameters)(0, 2), 0.5, 1e-5);
}

TEST(PieceFeatures, NeighboursWithoutContourAreCloser) {
  const Bands bands = make_bands({{.5F, 0.F, 0.F}, {.6F, 0.F, 0.F}, {.5F, 0.F, 0.F}});
  PieceDistanceParameters parameters = plain;
  parameters.neighbour_gain = 1.0;
  parameters.neighbour_step = 2.0;
  const PieceFeatures features = measure_pieces(bands.picture, bands.pieces, parameters);
  const PairWeights distance = piece_distances(bands.picture, bands.pieces, features, parameters);
  EXPECT_NEAR(distance(0, 1), 1.0 - (2.0 - 1.0), 1e-5);
  EXPECT_NEAR(distance(0, 2), 0.0, 1e-5);
}

}  // namespace
}  // namespace belvedere
