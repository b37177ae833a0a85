#include "texture/segment/segment.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "texture/segment/segment_figures.h"

namespace belvedere {
namespace {

// Sky above, dark forest to the left, meadow to the right, all with grain: clearly three things.
int part(int x, int y) { return y < 60 ? 0 : (x < 80 + y / 8 ? 1 : 2); }
Grid<glm::vec3> landscape(int width, int height) {
  const glm::vec3 colours[3] = {{.8F, -.02F, -.06F}, {.35F, -.03F, .03F}, {.65F, -.08F, .1F}};
  Grid<glm::vec3> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
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
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 200; ++x) {
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
  Grid<glm::vec3> picture(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) picture(x, y) = glm::vec3(dark(x, y) ? .2F : .8F);
  const Grid<glm::vec3> reduced = reduce_blocks(picture, 3);
  Grid<std::uint16_t> of(reduced.width(), reduced.height());
  for (std::size_t i = 0; i < of.size(); ++i) of[i] = reduced[i].x < .5F ? 7 : 4;
  const Grid<std::uint16_t> whole = enlarge_pieces(of, picture, 3);
  int wrong = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) wrong += whole(x, y) == (dark(x, y) ? 7 : 4) ? 0 : 1;
  EXPECT_LE(wrong, 6);
  EXPECT_EQ(enlarge_pieces(of, reduced, 1), of);
}

}  // namespace
}  // namespace belvedere
