// `belvedere figure` as users meet it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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

// Where a picture lies in a sheet; -1 where it does not.
glm::ivec2 found_in(const Grid<glm::vec3>& sheet, const Grid<glm::vec3>& picture) {
  for (int y0 = 0; y0 + picture.height() <= sheet.height(); ++y0)
    for (int x0 = 0; x0 + picture.width() <= sheet.width(); ++x0) {
      bool same = true;
      for (int y = 0; same && y < picture.height(); ++y)
        same = std::equal(picture.row(y), picture.row(y) + picture.width(), sheet.row(y0 + y) + x0);
      if (same) return {x0, y0};
    }
  return glm::ivec2(-1);
}

TEST_F(Figure, ShowsGuidesOfThePictureAndOfWhatItCopiesFrom) {
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
  // Distance: black nearest, white farthest of both columns, straight in its logarithm.
  const Grid<glm::vec3> distance = read_picture(path("out/picture_distance.png"));
  std::vector<std::pair<float, float>> by_depth;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (!guidance.is_sky(i))
      by_depth.emplace_back(std::log(std::max(guidance.depth_m[i], 500.F)), distance[i].r);
  const auto [near, far] = std::minmax_element(by_depth.begin(), by_depth.end());
  ASSERT_GT(far->second, near->second + 0.2F);
  const float slope = (far->second - near->second) / (far->first - near->first);
  for (const auto& [log_m, grey] : by_depth)
    ASSERT_NEAR(grey, near->second + slope * (log_m - near->first), 0.04F);
  // The example sheet that texels come from, with the same two.
  for (const char* name : {"out/copied_1.png", "out/copied_1_landcover.png",
                           "out/copied_1_altitude.png", "out/copied_1_distance.png"}) {
    const Grid<glm::vec3> picture = read_picture(path(name));
    EXPECT_EQ(picture.width(), 240) << name;
    EXPECT_EQ(picture.height(), 180) << name;
  }
  const Grid<glm::vec3> sheet = read_picture(path("out/sheet.png"));
  EXPECT_GT(sheet.width(), 360);
  EXPECT_GT(sheet.height(), 3 * 180);
  // Land cover above altitude above distance above paint, what is copied from at the left of the
  // picture.
  const auto corner = [&](const std::string& name) {
    return found_in(sheet, read_picture(path("out/" + name + ".png")));
  };
  for (const std::string column : {"copied_1", "picture"}) {
    const glm::ivec2 cover = corner(column + "_landcover");
    const glm::ivec2 heights = corner(column + "_altitude");
    const glm::ivec2 distances = corner(column + "_distance");
    const glm::ivec2 paint = corner(column);
    ASSERT_TRUE(cover.x >= 0 && heights.x >= 0 && distances.x >= 0 && paint.x >= 0) << column;
    for (const glm::ivec2 other : {heights, distances, paint}) EXPECT_EQ(cover.x, other.x);
    EXPECT_LT(cover.y, heights.y) << column;
    EXPECT_LT(heights.y, distances.y) << column;
    EXPECT_LT(distances.y, paint.y) << column;
  }
  EXPECT_GE(corner("picture").x, corner("copied_1").x + 240);
  // The example sheet's own: classes in their colours, altitudes in grey, paint in neither.
  const auto kinds = [&](const std::string& name) {
    std::size_t grey = 0;
    std::size_t flat = 0;
    const Grid<glm::vec3> picture = read_picture(path("out/" + name + ".png"));
    for (const glm::vec3& colour : picture) {
      grey += colour.r == colour.g && colour.g == colour.b ? 1 : 0;
      flat += std::any_of(land_cover_classes().begin(), land_cover_classes().end(),
                          [&](const LandCoverClassInfo& info) {
                            const auto byte = [](float v) {
                              return static_cast<std::uint32_t>(std::lround(255.F * v));
                            };
                            return info.rgb ==
                                   (byte(colour.r) << 16U | byte(colour.g) << 8U | byte(colour.b));
                          })
                  ? 1
                  : 0;
    }
    const auto share = [&](std::size_t count) {
      return static_cast<double>(count) / static_cast<double>(picture.size());
    };
    return std::pair(share(grey), share(flat));
  };
  const auto [cover_grey, cover_flat] = kinds("copied_1_landcover");
  const auto [heights_grey, heights_flat] = kinds("copied_1_altitude");
  const auto [paint_grey, paint_flat] = kinds("copied_1");
  EXPECT_GT(cover_flat, 0.5);
  EXPECT_LT(paint_flat, 0.1);
  EXPECT_LT(cover_grey, 0.6);
  EXPECT_GT(heights_grey, 0.7);
  EXPECT_LT(paint_grey, 0.5);
  EXPECT_LT(heights_flat, 0.6);
}

}  // namespace
}  // namespace belvedere
