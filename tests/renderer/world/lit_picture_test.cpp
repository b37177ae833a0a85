#include "renderer/world/lit_picture.h"

#include <gtest/gtest.h>

#include <string>

#include "base/guidance_channels.h"
#include "renderer/paint/composite.h"
#include "tests/renderer/exemplar/painted_hills.h"
#include "tests/renderer/world/small_world.h"

namespace belvedere {
namespace {

using test::small_scene;

PixelRect whole_picture(const Scene& scene) { return {0, 0, scene.output.width, scene.output.height}; }

TEST(LitPicture, ItsGuidanceHasToneAndBase) {
  const World world(small_scene(), silent_progress());
  const LitPicture lit = make_lit_picture(world, read_palette("summer"), whole_picture(world.scene), {});
  EXPECT_TRUE(lit.guidance.base == decode_srgb(lit.base.colour));
  for (const float tone : lit.guidance.tone) {
    ASSERT_GE(tone, 0.F);
    ASSERT_LE(tone, 1.02F);
  }
}

TEST(LitPicture, WithoutSunTheDirectionOfTheSunNoLongerCounts) {
  const auto tone = [](const std::string& altitude, const std::string& strength) {
    const World world(small_scene({"sun.altitude_deg=" + altitude, "light.sun=" + strength}), silent_progress());
    return make_lit_picture(world, read_palette("summer"), whole_picture(world.scene), {}).guidance.tone;
  };
  EXPECT_TRUE(tone("-3", "0.9") == tone("-3", "0"));
  EXPECT_FALSE(tone("30", "0.9") == tone("30", "0"));
}

TEST(LitPicture, RockTakesItsKindFromTheSceneAndItsSnowFromThePalette) {
  const World world(small_scene({"land_cover.rock=granite"}), silent_progress());
  const SheetView view = view_of(world);
  EXPECT_EQ(to_rock_parameters(world, read_palette("summer"), view).kind->name, "granite");
  EXPECT_EQ(to_base_parameters(world, view, read_palette("summer")).rock->name, "granite");
  EXPECT_FALSE(to_rock_parameters(world, read_palette("summer"), view).winter);
  EXPECT_TRUE(to_rock_parameters(world, read_palette("winter"), view).winter);
}

TEST(LitPicture, StrokesTakeTheHandOfSceneAndPalette) {
  const World world(small_scene({"seed=9", "sun.azimuth_deg=270"}), silent_progress());
  const StrokeParameters winter = to_stroke_parameters(world, read_palette("winter"));
  EXPECT_TRUE(winter.winter);
  EXPECT_FALSE(to_stroke_parameters(world, read_palette("summer")).winter);
  EXPECT_EQ(winter.seed, 9U);
  EXPECT_EQ(winter.sun_side, -1.0) << "the sun stands in the west, the view goes north";
  EXPECT_EQ(winter.pixels_per_unit, 0.5) << "a unit is half a millimetre, a pixel a millimetre";
}

}  // namespace
}  // namespace belvedere
