// `belvedere figure` as users meet it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/land_cover_class.h"
#include "renderer/image/guidance_io.h"
#include "tests/tools/cli/contact/contact_scene.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

const std::string figure_scene = std::string(test::contact_scene) + R"(
[[exemplar]]
width = 240
height = 180
)";

class Figure : public Program {};

TEST_F(Figure, ShowsClassesAndAltitudesOfThePictureAndOfWhatItCopiesFrom) {
  const std::string file = write("s.toml", figure_scene);
  const Outcome outcome = run({"figure", file, "--quiet", "--out", path("out")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  ASSERT_EQ(run({"render", file, "--quiet", "--channels", "Z,landcover.id,altitude.V", "--out",
                 path("one")})
                .status,
            0);
  EXPECT_EQ(read_picture(path("out/picture.png")), read_picture(path("one/panorama.png")));
  const GuidanceBuffers guidance = read_guidance(path("one/guidance.exr"));
  const Grid<glm::vec3> classes = read_picture(path("out/picture_landcover.png"));
  const Grid<glm::vec3> altitude = read_picture(path("out/picture_altitude.png"));
  ASSERT_TRUE(classes.same_size(guidance.land_cover));
  float lowest = 1e9F;
  float highest = 0.F;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (guidance.is_sky(i)) continue;
    const std::uint32_t rgb =
        land_cover_classes()[static_cast<std::size_t>(guidance.land_cover[i])].rgb;
    const auto byte = [](float v) { return static_cast<std::uint32_t>(std::lround(255.F * v)); };
    ASSERT_EQ(byte(classes[i].r) << 16U | byte(classes[i].g) << 8U | byte(classes[i].b), rgb) << i;
    ASSERT_NEAR(255.F * altitude[i].r, guidance.altitude_m[i] / 20.F, 0.51F) << i;  // 20 m a step
    lowest = std::min(lowest, guidance.altitude_m[i]);
    highest = std::max(highest, guidance.altitude_m[i]);
  }
  EXPECT_GT(highest, lowest + 500.F);
  // The example sheet that texels come from, with the same two.
  for (const char* name :
       {"out/copied_1.png", "out/copied_1_landcover.png", "out/copied_1_altitude.png"}) {
    const Grid<glm::vec3> picture = read_picture(path(name));
    EXPECT_EQ(picture.width(), 240) << name;
    EXPECT_EQ(picture.height(), 180) << name;
  }
  const Grid<glm::vec3> sheet = read_picture(path("out/sheet.png"));
  EXPECT_GT(sheet.width(), 360);
  EXPECT_GT(sheet.height(), 3 * 180);
}

}  // namespace
}  // namespace belvedere
