#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "renderer/exemplar/light/painting_tone.h"
#include "renderer/image/guidance_io.h"
#include "tests/tools/program.h"
#include "texture/synthesis/exemplar.h"

// Shadows and valleys found in the program's own pictures, whose guidance knows both.

namespace belvedere {
namespace {

// Agreement of what is found with what is there.
struct FoundPlaces {
  double both = 0.0, found = 0.0, there = 0.0;
  void add(bool is_found, bool is_there) {
    both += is_found && is_there ? 1.0 : 0.0;
    found += is_found ? 1.0 : 0.0;
    there += is_there ? 1.0 : 0.0;
  }
  double f1() const { return 2.0 * both / std::max(found + there, 1.0); }
};

class PaintedShadeLong : public Program {};

TEST_F(PaintedShadeLong, ShadowsAndValleysAreThoseOfThePicturesGround) {
  for (const char* place : {"/innsbruck", "/oetztal"})
    if (!std::filesystem::exists(test::data_folder() + place))
      GTEST_SKIP() << test::data_folder() << place << " is missing";
  constexpr float low_m = 60.0F;
  double shadows = 0.0, valleys = 0.0;
  const std::array<const char*, 3> scenes = {"karwendel", "karwendel_evening", "oetztal"};
  for (const std::string scene : scenes) {
    const Outcome made =
        run({"render", test::source_folder() + "/scenes/" + scene + ".toml", "--data",
             test::data_folder(), "--set", "output.width=800", "--set", "output.height=440",
             "--set", "output.formats=[\"png\"]", "--channels", "Z,landcover.id,shadow.V,valley.V",
             "--out", path(scene), "-q"});
    ASSERT_EQ(made.status, 0) << made.err;
    const Grid<glm::vec3> picture = read_picture(path(scene + "/panorama.png"));
    const GuidanceBuffers truth = read_guidance(path(scene + "/guidance.exr"));
    Grid<std::uint8_t> labels(picture.width(), picture.height());
    for (std::size_t i = 0; i < labels.size(); ++i)
      labels[i] = truth.is_sky(i) ? unused_label : static_cast<std::uint8_t>(truth.land_cover[i]);
    const Grid<float> shadow = find_shadow(picture, labels, 6.0);
    const Grid<float> height_m = find_valley_height(labels);
    FoundPlaces of_shadow, of_valley;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == unused_label) continue;
      of_shadow.add(shadow[i] < lit_from, truth.shadow[i] < lit_from);
      of_valley.add(height_m[i] < low_m, truth.valley_height_m[i] < low_m);
    }
    fmt::print("{}: F1 of shadow {:.2f}, of valleys {:.2f}\n", scene, of_shadow.f1(),
               of_valley.f1());
    EXPECT_GT(of_shadow.f1(), 0.48) << scene;
    EXPECT_GT(of_valley.f1(), 0.5) << scene;
    shadows += of_shadow.f1() / static_cast<double>(scenes.size());
    valleys += of_valley.f1() / static_cast<double>(scenes.size());
  }
  EXPECT_GE(shadows, 0.6);
  EXPECT_GE(valleys, 0.6);
}

}  // namespace
}  // namespace belvedere
