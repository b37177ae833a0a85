// `belvedere diff` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;

TEST_F(Program, DiffHasThresholds) {
  const auto grey = [](int x, int y) { return glm::vec3(static_cast<float>(x + y) / 255.F); };
  const std::string a = write_picture("a.png", 40, 30, grey);
  const std::string same = write_picture("same.png", 40, 30, grey);
  // One pixel of 1200 is 51/255 lighter in red.
  const std::string b = write_picture("b.png", 40, 30, [&](int x, int y) {
    return grey(x, y) + (x == 7 && y == 9 ? glm::vec3(51.F / 255.F, 0.F, 0.F) : glm::vec3(0.F));
  });
  const std::string small = write_picture("small.png", 39, 30, grey);
  EXPECT_EQ(run({"diff", a, same}).status, 0);
  EXPECT_EQ(run({"diff", a, b}).status, 1);
  EXPECT_EQ(run({"diff", a, b, "--max-difference", "0.21"}).status, 0);
  EXPECT_EQ(run({"diff", a, b, "--max-difference", "0.19"}).status, 1);
  EXPECT_EQ(run({"diff", a, b, "--max-mean", "0.0002"}).status, 0);
  EXPECT_EQ(run({"diff", a, b, "--max-mean", "0.0001"}).status, 1);
  EXPECT_EQ(run({"diff", a, b, "--max-mean", "0.0002", "--max-difference", "0.19"}).status, 1);
  const Outcome sizes = run({"diff", a, small, "--max-difference", "1"});
  EXPECT_EQ(sizes.status, 1);
  EXPECT_THAT(sizes.out, HasSubstr("40 × 30 pixels against 39 × 30"));
  EXPECT_EQ(run({"diff", a, path("none.png")}).status, 3);
  EXPECT_EQ(run({"info", write("text.png", "no picture")}).status, 3);
}

}  // namespace
}  // namespace belvedere
