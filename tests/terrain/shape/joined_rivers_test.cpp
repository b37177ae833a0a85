#include "terrain/shape/joined_rivers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace belvedere {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const glm::dvec2 a{0.0, 0.0}, b{10.0, 0.0}, c{20.0, 5.0}, d{30.0, 5.0}, e{20.0, -9.0};

MappedRiver line(std::vector<glm::dvec2> positions, double width_m = 0.0, int group = 0) {
  return {.positions = std::move(positions), .width_m = width_m, .group = group};
}

TEST(JoinedRivers, PiecesFollowEachOtherInAnyOrderAndDirection) {
  const JoinedLines river = join_lines({line({c, d}, 4.0), line({b, a}, 9.0), line({b, c})});
  ASSERT_THAT(river.lines, SizeIs(1));
  const bool down = river.lines[0].positions.front() == a;
  if (down)
    EXPECT_THAT(river.lines[0].positions, ElementsAre(a, b, c, d));
  else
    EXPECT_THAT(river.lines[0].positions, ElementsAre(d, c, b, a));
  EXPECT_EQ(river.lines[0].width_m, 9.0) << "as wide as its widest piece";
  EXPECT_EQ(river.joined, 2U);
}

TEST(JoinedRivers, WhereThreeMeetAllEnd) {
  const JoinedLines fork = join_lines({line({a, b}), line({b, c}), line({b, e})});
  EXPECT_THAT(fork.lines, SizeIs(3));
  EXPECT_EQ(fork.joined, 0U);
}

TEST(JoinedRivers, OtherGroupsAreOtherRivers) {
  EXPECT_THAT(join_lines({line({a, b}, 0.0, 1), line({b, c}, 0.0, 2)}).lines, SizeIs(2));
  EXPECT_THAT(join_lines({line({a, b}, 0.0, 1), line({b, c}, 0.0, 1)}).lines, SizeIs(1));
}

TEST(JoinedRivers, ARingEndsWhereItBegan) {
  const JoinedLines ring = join_lines({line({a, b, c}), line({c, e, a})});
  ASSERT_THAT(ring.lines, SizeIs(1));
  EXPECT_EQ(ring.lines[0].positions.front(), ring.lines[0].positions.back());
  EXPECT_THAT(ring.lines[0].positions, SizeIs(5));
  // A closed line has no continuation.
  EXPECT_THAT(join_lines({line({a, b, c, a})}).lines,
              ElementsAre(::testing::Field(&MappedRiver::positions, ElementsAre(a, b, c, a))));
}

TEST(JoinedRivers, PlacesWithoutALineAreLeftOut) {
  EXPECT_THAT(join_lines({line({a}), line({})}).lines, IsEmpty());
  EXPECT_THAT(join_lines({line({a, b}), line({b})}).lines, SizeIs(1));
}

}  // namespace
}  // namespace belvedere
