// `belvedere texture erode` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class TextureErode : public Program {
 protected:
  std::string write_disc() const {
    return write_labels("snow.tif", 90, 80, [](int x, int y) {
      return (x - 45) * (x - 45) + (y - 40) * (y - 40) < 30 * 30 ? 8 : x < 45 ? 6 : 7;
    });
  }
};

TEST_F(TextureErode, WritesAMonotoneSeriesThatReadsBack) {
  const std::string mask = write_labels("snow.tif", 90, 80, [](int x, int y) {
    return (x - 45) * (x - 45) + (y - 40) * (y - 40) < 30 * 30;
  });
  const Outcome eroded = run({"texture", "erode", mask, "--out", path("series"), "--steps", "3",
                              "--step-px", "6", "--report", path("page")});
  ASSERT_EQ(eroded.status, 0) << eroded.err;
  EXPECT_THAT(eroded.out,
              AllOf(HasSubstr("snow_01.png"), HasSubstr("snow_03.png"), HasSubstr("pixels left")));
  EXPECT_THAT(eroded.err, HasSubstr("eroding"));
  EXPECT_THAT(read_bytes(path("page/index.html")),
              AllOf(HasSubstr("snow_03.png"), HasSubstr("--step-px 6")));
  Grid<std::uint16_t> before = read_grey(mask);
  for (const char* name : {"series/snow_01.png", "series/snow_02.png", "series/snow_03.png"}) {
    const Grid<std::uint16_t> now = read_grey(path(name));
    int taken = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      ASSERT_TRUE(now[i] == 0 || (now[i] == 255 && before[i] != 0));
      taken += now[i] == 0 && before[i] != 0 ? 1 : 0;
    }
    EXPECT_GT(taken, 300);
    before = now;
  }
  // On the page white remains, and the darkest was eroded first.
  const Grid<glm::vec3> shown = read_picture(path("page/steps.png"));
  const Grid<std::uint16_t> first = read_grey(path("series/snow_01.png"));
  const Grid<std::uint16_t> whole = read_grey(mask);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    ASSERT_EQ(shown[i].x == 1.F, before[i] != 0);
    ASSERT_EQ(shown[i].x > .3F && shown[i].x < .5F, whole[i] != 0 && first[i] == 0);
  }
}

TEST_F(TextureErode, AClassGivesItsPlaceToThoseAround) {
  const std::string map = write_disc();
  ASSERT_EQ(run({"texture", "erode", map, "--out", path("series"), "--label", "8", "--keep", "6",
                 "--steps", "2", "-q"})
                .status,
            0);
  const Grid<std::uint16_t> before = read_grey(map);
  const Grid<std::uint16_t> after = read_grey(path("series/snow_02.png"));
  int to_rock = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (before[i] != 8) {
      ASSERT_EQ(after[i], before[i]);
    }
    ASSERT_TRUE(after[i] == before[i] || after[i] == 7) << "6 takes nothing";
    to_rock += before[i] == 8 && after[i] == 7 ? 1 : 0;
  }
  EXPECT_GT(to_rock, 300);
}

TEST_F(TextureErode, BadInputIsNamed) {
  const Outcome gone = run({"texture", "erode", path("gone.png"), "--out", path("series")});
  EXPECT_EQ(gone.status, 3);
  EXPECT_THAT(gone.err, HasSubstr("gone.png"));
  EXPECT_EQ(run({"texture", "erode", write_disc(), "--out", path("series"), "--steps", "0"}).status,
            2);
}

// Dark cracks of a crop over another picture: nothing there becomes lighter, each step goes on from
// the one before.
TEST_F(TextureErode, LaysTheCracksOfACropOverAPicture) {
  const auto shade = [](int x, int y) {
    return .5F + .02F * static_cast<float>((x * 7 + y * 3) % 9);
  };
  const std::string wall = write_picture("wall.png", 72, 64, [&](int x, int y) {
    return (x + y / 3) % 18 < 3 ? glm::vec3(.05F) : glm::vec3(shade(x, y));
  });
  const std::string intact =
      write_picture("new.png", 60, 50, [&](int x, int y) { return glm::vec3(shade(y, x) + .2F); });
  ASSERT_THAT(run({"texture", "erode", wall, "--over", intact, "--darkest", "0.16", "--steps", "2",
                   "--out", path("ages"), "--report", path("page"), "-q", "--json"}),
              Prints(AllOf(HasSubstr("new_01.png"), HasSubstr("new_02.png"))));
  EXPECT_THAT(read_bytes(path("page/index.html")), HasSubstr("weathered.png"));
  Grid<glm::vec3> before = read_picture(intact);
  for (const char* name : {"ages/new_01.png", "ages/new_02.png"}) {
    const Grid<glm::vec3> now = read_picture(path(name));
    int darker = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      ASSERT_LE(now[i].x, before[i].x);
      darker += now[i].x < before[i].x - .2F ? 1 : 0;
    }
    EXPECT_GT(darker, 60) << name;
    before = now;
  }
}

}  // namespace
}  // namespace belvedere
