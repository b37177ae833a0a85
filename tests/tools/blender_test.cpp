// tools/blender/compositing.py in Blender itself, on guidance of `render --channels blender`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "renderer/image/exr/compositing_file.h"
#include "renderer/image/image_io.h"
#include "renderer/paint/composite.h"
#include "tests/paths.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

class BlenderLong : public Program {
 protected:
  void SetUp() override {
    if (std::system("command -v blender >/dev/null") != 0)
      GTEST_SKIP() << "blender is not installed: tools/setup blender";
    ASSERT_EQ(run({"render", write_scene_file("title = \"Test hills\"\n"), "--out", path("out"),
                   "--quiet", "--channels", "blender", "--set", "camera.pitch_deg=-20", "--set",
                   "output.formats=[\"png\"]"})
                  .status,
              0);
    before_ = decode_srgb(read_picture(path("out/panorama.png")));
    id_ = pass("CryptoLandCover00.r");
    share_ = pass("CryptoLandCover00.g");
  }
  Grid<float> pass(const std::string& channel) const {
    return read_channel(path("out/guidance.exr"), "ViewLayer." + channel);
  }
  // The composite in linear light.
  Image composite(const std::string& options) const {
    const std::string command = "blender -b --factory-startup --python-exit-code 1 -P " +
                                test::source_folder() + "/tools/blender/compositing.py -- " +
                                path("out/guidance.exr") + " " + path("out/panorama.png") + " " +
                                path("composite.png") + " " + options + " >" + path("log") +
                                " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read_bytes(path("log"));
    return decode_srgb(read_picture(path("composite.png")));
  }
  // Whether a pixel shows nothing but one class.
  bool is_all(std::size_t i, const char* name) const {
    return id_[i] == cryptomatte_id(name) && share_[i] == 1.F;
  }

  Image before_;
  Grid<float> id_;
  Grid<float> share_;
};

TEST_F(BlenderLong, AClassIsChosenByItsName) {
  const Image after = composite("--light 0 --density 0 --mask forest --tint 0 0 0");
  ASSERT_TRUE(after.same_size(before_));
  std::size_t forest = 0;
  std::size_t others = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (share_[i] != 1.F) continue;
    const bool masked = is_all(i, "forest");
    (masked ? forest : others) += 1;
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(after[i][c], masked ? 0.F : before_[i][c], 0.002F) << i;
  }
  EXPECT_GT(forest, 100U);
  EXPECT_GT(others, 100U);
}

TEST_F(BlenderLong, FogFollowsTheDistance) {
  const Grid<float> depth_m = pass("Depth.Z");
  std::vector<float> depths;
  for (const float depth : depth_m)
    if (depth < 1e9F) depths.push_back(depth);
  std::nth_element(depths.begin(), depths.begin() + static_cast<long>(depths.size() / 2),
                   depths.end());
  const float middle_km = depths[depths.size() / 2] / 1000.F;
  const Image after =
      composite("--light 0 --density 1 --mask none --fog " + std::to_string(middle_km) + " " +
                std::to_string(middle_km + 0.001F));
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (share_[i] != 1.F || std::abs(depth_m[i] - 1000.F * middle_km) < 5.F) continue;
    const bool far = depth_m[i] > 1000.F * middle_km && !is_all(i, "sky");
    const glm::vec3 expected = far ? glm::vec3(0.86F, 0.74F, 0.66F) : before_[i];
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(after[i][c], expected[c], 0.002F) << i;
  }
}

TEST_F(BlenderLong, LightComesFromAnotherSide) {
  const Image after = composite("--light 1 --density 0 --mask none --sun 90 20");
  const Grid<float> east = pass("Normal.X");
  double lit = 0.0;
  double unlit = 0.0;
  int lit_count = 0;
  int unlit_count = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (is_all(i, "sky")) {
      ASSERT_NEAR(after[i].y, before_[i].y, 0.002F) << i;
      continue;
    }
    if (std::abs(east[i]) < 0.2F || before_[i].y < 0.05F) continue;
    (east[i] > 0.F ? lit : unlit) += after[i].y / before_[i].y;
    (east[i] > 0.F ? lit_count : unlit_count) += 1;
  }
  ASSERT_GT(lit_count, 30);
  ASSERT_GT(unlit_count, 30);
  EXPECT_GT(lit / lit_count, 1.3 * unlit / unlit_count);
}

}  // namespace
}  // namespace belvedere
