// `belvedere sweep` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <glm/vec2.hpp>

#include "tests/tools/cli/contact/contact_scene.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string sweep_scene = std::string(test::contact_scene) + R"(
[synthesis]
enabled = false
)";

class Sweep : public Program {};

TEST_F(Sweep, EachPictureIsTheRenderOfItsValues) {
  const std::string file = write("s.toml", sweep_scene);
  const Outcome outcome = run({"sweep", file, "--quiet", "--set", "sun.azimuth_deg=200,320",
                               "--set", "air.haze=0.1", "--out", path("out")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Outcome one = run({"render", file, "--quiet", "--set", "sun.azimuth_deg=320", "--set",
                           "air.haze=0.1", "--channels", "none", "--out", path("one")});
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_FALSE(std::filesystem::exists(path("one/guidance.exr")));
  const Grid<glm::vec3> second = read_picture(path("out/2_1.png"));
  EXPECT_EQ(second, read_picture(path("one/panorama.png")));
  EXPECT_NE(second, read_picture(path("out/1_1.png")));
  // Small pictures stand on the sheet pixel by pixel, side by side.
  const Grid<glm::vec3> first = read_picture(path("out/1_1.png"));
  const Grid<glm::vec3> sheet = read_picture(path("out/sheet.png"));
  const auto position = [&](const Grid<glm::vec3>& picture) {
    const int y = picture.height() / 2;
    for (int v = 0; v < sheet.height(); ++v)
      for (int u = 0; u + picture.width() <= sheet.width(); ++u)
        if (std::equal(picture.row(y), picture.row(y) + picture.width(), sheet.row(v) + u))
          return glm::ivec2(u, v);
    return glm::ivec2(-1);
  };
  EXPECT_GE(position(first).x, 0);
  EXPECT_EQ(position(first).y, position(second).y);
  EXPECT_GE(position(second).x, position(first).x + 120);
  EXPECT_THAT(read_bytes(path("out/report.json")),
              AllOf(HasSubstr("\"sun.azimuth_deg\": \"320\""), HasSubstr("2_1.png")));
}

TEST_F(Sweep, WrongValuesAreRefusedBeforeTheFirstPicture) {
  const std::string file = write("s.toml", sweep_scene);
  EXPECT_THAT(run({"sweep", file, "--quiet", "--set", "air.haze=0.1,7", "--out", path("out")}),
              Ends(2, HasSubstr("haze")));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
  EXPECT_EQ(run({"sweep", file, "--quiet", "--set", "air.haze=0.1", "--out", path("out")}).status,
            2);
}

}  // namespace
}  // namespace belvedere
