#include "renderer/paint/water/water_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "base/error.h"
#include "base/grid_part.h"
#include "renderer/paint/sky.h"

namespace belvedere {
namespace {

TEST(WaterImage, FresnelHasItsKnownValues) {
  EXPECT_NEAR(water_fresnel(1.0), std::pow(0.333 / 2.333, 2.0), 1e-12);
  EXPECT_NEAR(water_fresnel(0.0), 1.0, 1e-12);
  // At Brewster's angle only one polarization is reflected: half of ((n² - 1) / (n² + 1))².
  const double n2 = 1.333 * 1.333;
  EXPECT_NEAR(water_fresnel(1.0 / std::sqrt(1.0 + n2)),
              0.5 * std::pow((n2 - 1.0) / (n2 + 1.0), 2.0), 1e-12);
  EXPECT_NEAR(water_fresnel(0.5), 0.0597, 5e-4);  // 60° from the normal
  for (double c = 0.0; c < 1.0; c += 0.02) EXPECT_GT(painted_mirror(c), painted_mirror(c + 0.02));
  EXPECT_NEAR(painted_mirror(0.5), std::pow(water_fresnel(0.5), 0.4), 1e-9);
}

constexpr int width = 12;
constexpr int height = 160;

// Water everywhere, 20 km away, seen at 60° from its normal; the upper half reflects a lit forest,
// the lower the sky.
struct FarLake {
  GuidanceBuffers guidance;
  MirrorSight sight;
  Palette palette = read_palette("summer");
  WaterImageParameters parameters;
  FarLake() {
    guidance.depth_m = Grid<float>(width, height, 20000.0F);
    guidance.footprint_m = Grid<float>(width, height, 8.0F);
    guidance.altitude_m = Grid<float>(width, height, 900.0F);
    guidance.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::water);
    sight.cosine = sight.rise = Grid<float>(width, height, 0.5F);
    sight.distance_m = Grid<float>(width, height, 20000.0F);
    sight.path_m = Grid<float>(width, height, std::numeric_limits<float>::infinity());
    sight.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::sky);
    sight.altitude_m = Grid<float>(width, height, 1000.0F);
    sight.normal = Grid<glm::vec3>(width, height, glm::vec3(0.0F, 0.0F, 1.0F));
    sight.shadow = Grid<float>(width, height, 1.0F);
    for (int y = 0; y < height / 2; ++y)
      for (int x = 0; x < width; ++x) {
        sight.path_m(x, y) = 400.0F;
        sight.land_cover(x, y) = LandCoverClass::forest;
      }
  }
  WaterImage paint(PixelRect wanted = {0, 0, width, height}) const {
    return paint_water_image(sight, {0, 0, width, height}, guidance, palette, parameters, wanted);
  }
};

TEST(WaterImage, MirrorsLandDarkAndSkyByItsHeight) {
  const FarLake lake;
  const WaterImage image = lake.paint();
  EXPECT_NEAR(image.land(4, 10), 1.0F, 1e-6F);
  EXPECT_NEAR(image.land(4, height - 10), 0.0F, 1e-6F);
  EXPECT_NEAR(image.share(4, height - 10), painted_mirror(0.5), 1e-5);
  EXPECT_NEAR(image.share(4, 10), 1.5 * painted_mirror(0.5), 1e-5);
  const glm::vec3 sky = sky_gradient(lake.palette, 1.0 - 0.5 / 0.8) * 0.93F;  // of its blue
  EXPECT_NEAR(image.colour(4, height - 10).b, sky.b, 1e-5F);
  EXPECT_NEAR(image.sky(4, 10).b, sky.b, 1e-6F) << "what ruffled water shows in the land's image";
  // Lit forest, darker and bluer than itself: within its ramp.
  EXPECT_LT(image.colour(4, 10).r,
            0.67F * palette_colour(lake.palette, LandCoverClass::forest, 1000.0, 1.0).r);
  EXPECT_GT(image.colour(4, 10).r,
            0.65F * palette_colour(lake.palette, LandCoverClass::forest, 1000.0, 0.3).r);
}

TEST(WaterImage, TheImageOfAShadyBankIsDarker) {
  FarLake shady;
  for (float& lit : shady.sight.shadow) lit = 0.0F;
  EXPECT_LT(shady.paint().colour(4, 10).g, FarLake().paint().colour(4, 10).g - 0.05F);
}

TEST(WaterImage, FarThingsStandInTheAirOfTheWholeWay) {
  FarLake far;
  for (int y = 0; y < height / 2; ++y)
    for (int x = 0; x < width; ++x) far.sight.path_m(x, y) = 80000.0F;
  const glm::vec3 near_wood = FarLake().paint().colour(4, 10);
  const glm::vec3 far_wood = far.paint().colour(4, 10);
  EXPECT_GT(far_wood.b, near_wood.b + 0.1F);
}

// Waves turn rays by about .06 rad: over 400 m of 20400 by .0012 rad, with 2500 pixels per rad, so
// by about 3 px.
TEST(WaterImage, IsDrawnOutDownwardsByWhatLiesFarFromTheWater) {
  FarLake lake;
  const auto border_rows = [&](float path_m) {
    for (int y = 0; y < height / 2; ++y)
      for (int x = 0; x < width; ++x) lake.sight.path_m(x, y) = path_m;
    const WaterImage image = lake.paint();
    int mixed = 0;
    for (int y = 0; y < height / 2; ++y) mixed += image.land(4, y) < 0.999F ? 1 : 0;
    return mixed;
  };
  EXPECT_LE(border_rows(10.0F), 2);
  EXPECT_GE(border_rows(400.0F), 4);
  EXPECT_GT(border_rows(2000.0F), border_rows(400.0F));
  EXPECT_LE(border_rows(50000.0F), water_image_margin_px(1.0));
}

TEST(WaterImage, APartIsThatOfTheWhole) {
  FarLake lake;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (x == 3 && y % 7 == 0) lake.guidance.land_cover(x, y) = LandCoverClass::pasture;
      lake.sight.path_m(x, y) += static_cast<float>((x * 37 + y * 91) % 700);
    }
  const WaterImage whole = lake.paint();
  const PixelRect wanted{2, 60, 9, 90};
  const int margin = water_image_margin_px(1.0);
  const PixelRect rect{2, 60 - margin, 9, 90 + margin};
  MirrorSight part;
  part.cosine = part_of(lake.sight.cosine, rect);
  part.distance_m = part_of(lake.sight.distance_m, rect);
  part.path_m = part_of(lake.sight.path_m, rect);
  part.rise = part_of(lake.sight.rise, rect);
  part.land_cover = part_of(lake.sight.land_cover, rect);
  part.altitude_m = part_of(lake.sight.altitude_m, rect);
  part.normal = part_of(lake.sight.normal, rect);
  part.shadow = part_of(lake.sight.shadow, rect);
  const WaterImage some =
      paint_water_image(part, rect, lake.guidance, lake.palette, lake.parameters, wanted);
  EXPECT_TRUE(some.colour == part_of(whole.colour, wanted));
  EXPECT_TRUE(some.share == part_of(whole.share, wanted));
  EXPECT_TRUE(some.land == part_of(whole.land, wanted));
  EXPECT_TRUE(some.sky == part_of(whole.sky, wanted));
  EXPECT_EQ(whole.share(3, 63), 0.0F) << "land mirrors nothing";
  EXPECT_THROW(
      paint_water_image(part, rect, lake.guidance, lake.palette, lake.parameters, {0, 0, width, 9}),
      Error);
}

TEST(WaterImage, StrengthIsTheScenes) {
  FarLake lake;
  lake.parameters.strength = 0.0;
  for (const float share : lake.paint().share) ASSERT_EQ(share, 0.0F);
}

}  // namespace
}  // namespace belvedere
