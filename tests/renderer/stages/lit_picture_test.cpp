#include "renderer/stages/lit_picture.h"

#include <gtest/gtest.h>

#include <glm/vec3.hpp>
#include <string>
#include <utility>

#include "base/guidance_buffers.h"
#include "renderer/image/srgb.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/light.h"
#include "renderer/stages/ground_inputs.h"
#include "tests/renderer/exemplar/painted_hills.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using test::small_scene;

PixelRect whole_picture(const Scene& scene) {
  return {0, 0, scene.output.width, scene.output.height};
}

TEST(LitPicture, ItsGuidanceHasToneAndBase) {
  const World world = make_world(small_scene(), silent_progress());
  const LitPicture lit =
      make_lit_picture(world, read_palette("summer"), whole_picture(world.scene), {});
  EXPECT_TRUE(lit.guidance.base == decode_srgb(lit.base.colour));
  for (const float tone : lit.guidance.tone) {
    ASSERT_GE(tone, 0.F);
    ASSERT_LE(tone, 1.02F);
  }
}

TEST(LitPicture, WithoutSunTheDirectionOfTheSunNoLongerCounts) {
  const auto tone = [](const std::string& altitude, const std::string& strength) {
    const World world = make_world(
        small_scene({"sun.altitude_deg=" + altitude, "light.sun=" + strength}), silent_progress());
    return make_lit_picture(world, read_palette("summer"), whole_picture(world.scene), {})
        .guidance.tone;
  };
  EXPECT_TRUE(tone("-3", "0.9") == tone("-3", "0"));
  EXPECT_FALSE(tone("30", "0.9") == tone("30", "0"));
}

double luminance(const glm::vec3& encoded) {
  const auto linear = [](float value) { return srgb_decoded(static_cast<double>(value)); };
  return 0.2126 * linear(encoded.x) + 0.7152 * linear(encoded.y) + 0.0722 * linear(encoded.z);
}

// Where colours are multiplied by light, sunlit ground is on average as light as its own colours:
// within 1 %, also for a sheet larger than the view on which this is measured. In the shade it is
// darker.
TEST(LitPicture, ColourTimesLightKeepsTheLuminanceOfLitGround) {
  const Palette palette = read_palette("summer");
  for (const auto& [width, height] : {std::pair{96, 80}, std::pair{1000, 500}}) {
    const World world =
        make_world(small_scene({"light.model=product", "air.from_m=1000000", "air.rim_fade_m=0",
                                "output.height=" + std::to_string(height),
                                "output.width=" + std::to_string(width)}),
                   silent_progress());
    const double mean_light =
        make_ground_inputs(world, view_of(world), palette, {}).base.mean_light;
    ASSERT_GT(mean_light, 0.0);
    const LitPicture lit = make_lit_picture(world, palette, whole_picture(world.scene), {});
    const GuidanceBuffers& g = lit.guidance;
    double seen[2] = {0.0, 0.0};
    double own[2] = {0.0, 0.0};  // without the light
    for (std::size_t i = 0; i < g.depth_m.size(); ++i) {
      if (g.is_sky(i) || g.land_cover[i] == LandCoverClass::water) continue;
      const int sunny = g.shadow[i] > 0.5F ? 1 : 0;
      const double luminance_seen = luminance(lit.base.colour[i]);
      seen[sunny] += luminance_seen;
      own[sunny] += luminance_seen * mean_light / static_cast<double>(light_of_tone(g.tone[i]));
    }
    RecordProperty(std::string("kept_") + (world.scene.output.width > 96 ? "large" : "small"),
                   std::to_string(seen[1] / own[1]));
    EXPECT_NEAR(seen[1] / own[1], 1.0, 0.01) << width;
    EXPECT_LT(seen[0] / own[0], 0.8) << width;
  }
  const World usual = make_world(small_scene(), silent_progress());
  EXPECT_EQ(make_ground_inputs(usual, view_of(usual), palette, {}).base.mean_light, 0.0)
      << "the palette's ramps";
}

}  // namespace
}  // namespace belvedere
