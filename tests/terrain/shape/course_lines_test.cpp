#include "terrain/shape/course_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace belvedere {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const glm::dvec2 a{0.0, 0.0}, b{10.0, 0.0}, c{20.0, 5.0}, d{30.0, 5.0}, e{20.0, -9.0};

DrawnCourse line(std::vector<glm::dvec2> places, double width_m = 0.0, int group = 0) {
  return {.places = std::move(places), .width_m = width_m, .group = group};
}

TEST(CourseLines, PiecesFollowEachOtherInAnyOrderAndDirection) {
  const JoinedLines river = join_lines({line({c, d}, 4.0), line({b, a}, 9.0), line({b, c})});
  ASSERT_THAT(river.lines, SizeIs(1));
  const bool down = river.lines[0].places.front() == a;
  if (down)
    EXPECT_THAT(river.lines[0].places, ElementsAre(a, b, c, d));
  else
    EXPECT_THAT(river.lines[0].places, ElementsAre(d, c, b, a));
  EXPECT_EQ(river.lines[0].width_m, 9.0) << "as wide as its widest piece";
  EXPECT_EQ(river.joined, 2U);
}

TEST(CourseLines, WhereThreeMeetAllEnd) {
  const JoinedLines fork = join_lines({line({a, b}), line({b, c}), line({b, e})});
  EXPECT_THAT(fork.lines, SizeIs(3));
  EXPECT_EQ(fork.joined, 0U);
}

TEST(CourseLines, OtherGroupsAreOtherRivers) {
  EXPECT_THAT(join_lines({line({a, b}, 0.0, 1), line({b, c}, 0.0, 2)}).lines, SizeIs(2));
  EXPECT_THAT(join_lines({line({a, b}, 0.0, 1), line({b, c}, 0.0, 1)}).lines, SizeIs(1));
}

TEST(CourseLines, ARingEndsWhereItBegan) {
  const JoinedLines ring = join_lines({line({a, b, c}), line({c, e, a})});
  ASSERT_THAT(ring.lines, SizeIs(1));
  EXPECT_EQ(ring.lines[0].places.front(), ring.lines[0].places.back());
  EXPECT_THAT(ring.lines[0].places, SizeIs(5));
  // One that closes by itself has nobody to go on with.
  EXPECT_THAT(join_lines({line({a, b, c, a})}).lines, ElementsAre(::testing::Field(&DrawnCourse::places, ElementsAre(a, b, c, a))));
}

TEST(CourseLines, PlacesWithoutALineAreLeftOut) {
  EXPECT_THAT(join_lines({line({a}), line({})}).lines, IsEmpty());
  EXPECT_THAT(join_lines({line({a, b}), line({b})}).lines, SizeIs(1));
}

}  // namespace
}  // namespace belvedere
