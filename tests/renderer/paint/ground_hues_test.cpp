#include "renderer/paint/ground_hues.h"

#include <gtest/gtest.h>

#include "base/noise.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

TEST(GroundHues, NoiseIsThatOfTheGroundAndFadesWhereItWouldBeSpecks) {
  GroundNoises noises(7);
  const glm::dvec3 position(1234.5, -987.25, 800.0);
  const Patches near = patches_at(noises, position, 0.0F);
  GroundNoises same(7);
  const Patches far = patches_at(same, position, 60.0F);
  EXPECT_EQ(far.n3, 0.5F * near.n3) << "a unit of the sheet covers a patch of 60 m";
  EXPECT_EQ(patches_at(same, position, 90.0F).n3, 0.0F);
  EXPECT_EQ(far.n8, near.n8);
  EXPECT_EQ(patches_at(same, position, 1000.0F).n25, near.n25) << "large patches stay";
  GroundNoises other(8);
  EXPECT_NE(patches_at(other, position, 0.0F).n60, near.n60);
}

TEST(GroundHues, RipeGrassIsYellowAndFreshGrassGreen) {
  const Patches none{0.0F, 0.0F, 0.0F, 0.0F};
  EXPECT_EQ(grass_shift(valley_floor, none, 0.0F), glm::vec3(0.0F));
  EXPECT_EQ(grass_shift(rock, {1.0F, 1.0F, 1.0F, 1.0F}, 12.0F), glm::vec3(0.0F));
  const glm::vec3 fresh = grass_shift(pasture, none, 0.0F);
  EXPECT_NEAR(fresh.r, -0.015F, 1e-6F);
  const glm::vec3 ripe = grass_shift(pasture, {0.0F, 2.0F, 0.0F, 0.0F}, 0.0F);
  EXPECT_NEAR(ripe.r, 0.11F * 0.25F, 1e-6F);
  EXPECT_LT(ripe.b, 0.0F);
  // Ridges are bleached by .16, hollows fresher by .24, in addition to the .15 of all high grass.
  EXPECT_NEAR(grass_shift(alpine_grass, none, 12.0F).r, 0.11F * (-0.15F + 0.16F), 1e-6F);
  EXPECT_NEAR(grass_shift(alpine_grass, none, -12.0F).r, 0.10F * (-0.15F - 0.24F), 1e-6F);
  EXPECT_EQ(grass_shift(valley_floor, none, 12.0F), glm::vec3(0.0F)) << "but not fields";
}

TEST(GroundHues, DriftOnlyOverWhatGrowsAndOverStone) {
  const Palette palette = read_palette("summer");
  const Patches patches{0.3F, 0.5F, 1.0F, -1.0F};
  for (const LandCoverClass still : {water, settlement, snow, glacier})
    EXPECT_EQ(hue_drift(still, patches, palette, 1.0F), glm::vec3(1.0F));
  EXPECT_EQ(hue_drift(rock, patches, palette, 0.0F), glm::vec3(1.0F));
  const float drift = -0.7F + 0.5F;
  EXPECT_NEAR(hue_drift(scree, patches, palette, 1.0F).r, 1.0F + 0.035F * drift, 1e-6F);
  EXPECT_NEAR(hue_drift(rock, patches, palette, 1.0F).r,
              (1.0F + 0.035F * drift) * (1.0F + 0.042F * 0.8F), 1e-6F);
  EXPECT_NEAR(hue_drift(forest, patches, palette, 1.0F).b,
              (1.0F - 0.03F * drift) * (1.0F - 0.05F * 0.95F), 1e-6F);
}

TEST(GroundHues, GreensGoStaleAndRockIsLessWarm) {
  for (const LandCoverClass green : {valley_floor, forest, alpine_grass, pasture, shrub})
    EXPECT_TRUE(has_trait(green, ClassTrait::desaturates));
  for (const LandCoverClass other : {water, settlement, scree, rock, snow, glacier})
    EXPECT_FALSE(has_trait(other, ClassTrait::desaturates));
  EXPECT_EQ(class_info(rock).hue.warmth, 0.6F);
  EXPECT_EQ(class_info(forest).hue.warmth, 1.0F);
}

}  // namespace
}  // namespace belvedere
