#include "renderer/world/picture_parameters.h"

#include <gtest/gtest.h>

#include "tests/scenes.h"

namespace belvedere {
namespace {

using test::small_scene;

TEST(PictureParameters, RockTakesItsKindFromTheSceneAndItsSnowFromThePalette) {
  const World world = make_world(small_scene({"land_cover.rock=granite"}), silent_progress());
  const SheetView view = view_of(world);
  EXPECT_EQ(to_rock_parameters(world, read_palette("summer"), view).kind->name, "granite");
  EXPECT_EQ(to_base_parameters(world, read_palette("summer"), view).rock->name, "granite");
  EXPECT_FALSE(to_rock_parameters(world, read_palette("summer"), view).winter);
  EXPECT_TRUE(to_rock_parameters(world, read_palette("winter"), view).winter);
}

TEST(PictureParameters, StrokesTakeTheHandOfSceneAndPalette) {
  const World world = make_world(small_scene({"seed=9", "sun.azimuth_deg=270"}), silent_progress());
  const StrokeParameters winter = to_stroke_parameters(world, read_palette("winter"));
  EXPECT_TRUE(winter.winter);
  EXPECT_FALSE(to_stroke_parameters(world, read_palette("summer")).winter);
  EXPECT_EQ(winter.seed, 9U);
  EXPECT_EQ(winter.sun_side, -1.0) << "the sun stands in the west, the view goes north";
  EXPECT_EQ(winter.pixels_per_unit, 0.5) << "a unit is half a millimetre, a pixel a millimetre";
}

}  // namespace
}  // namespace belvedere
