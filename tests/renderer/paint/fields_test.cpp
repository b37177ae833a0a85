#include "renderer/paint/fields.h"

#include <gtest/gtest.h>

#include "tests/renderer/paint/near_colours.h"

namespace belvedere {
namespace {

using test::expect_near;

// A position in the centre of a field.
Parcel open_field(Crop crop) {
  return {.crop = crop,
          .shade = 0.0F,
          .border_m = 45.0F,
          .width_m = 90.0F,
          .lane_m = 400.0F,
          .hedged = false};
}

TEST(Fields, AreCropsNearByAndOneColourFarAway) {
  const glm::vec3 apart = crop_colour(Crop::ripe) - mean_crop_colour();
  const auto colour = [](float metres_per_unit, float air) {
    return field_colour(open_field(Crop::ripe), 0.0F, metres_per_unit, air, 1.0F);
  };
  expect_near(colour(0.0F, 0.0F), mean_crop_colour() + 1.15F * apart);
  expect_near(colour(9.0F, 0.0F), mean_crop_colour() + 1.15F * apart);
  expect_near(colour(12.0F, 0.0F), mean_crop_colour() + 0.85F * apart);
  expect_near(colour(90.0F, 0.0F), mean_crop_colour() + 0.55F * apart);
  expect_near(colour(90.0F, 1.0F), mean_crop_colour() + 0.55F * 0.65F * apart);
}

TEST(Fields, GiveWayToHayTowardsTheSlopes) {
  const auto colour = [](float slope_deg) {
    return field_colour(open_field(Crop::ripe), slope_deg, 0.0F, 0.0F, 1.0F);
  };
  EXPECT_EQ(colour(3.0F), colour(0.0F));
  expect_near(colour(4.25F), 0.5F * (colour(0.0F) + crop_colour(Crop::hay)));
  expect_near(colour(5.5F), crop_colour(Crop::hay));
}

TEST(Fields, HaveDarkBordersAndPaleLanes) {
  Parcel parcel = open_field(Crop::clover);
  const glm::vec3 centre = field_colour(parcel, 0.0F, 18.0F, 0.0F, 1.0F);
  parcel.border_m = 0.0F;
  expect_near(field_colour(parcel, 0.0F, 18.0F, 0.0F, 1.0F), centre * (1.0F - 0.05F * 0.55F));
  parcel.hedged = true;
  expect_near(field_colour(parcel, 0.0F, 18.0F, 0.0F, 1.0F), centre * (1.0F - 0.13F * 0.55F));
  Parcel lane = open_field(Crop::clover);
  lane.lane_m = 0.0F;
  const float share = 0.55F * 0.55F;
  expect_near(field_colour(lane, 0.0F, 18.0F, 0.0F, 1.0F),
              centre * (1.0F - share) + glm::vec3(1.02F, 0.99F, 1.05F) * share);
}

TEST(Fields, AreAsStrongAsHueDriftSays) {
  EXPECT_EQ(field_colour(open_field(Crop::ploughed), 0.0F, 0.0F, 0.0F, 0.0F), glm::vec3(1.0F));
  const glm::vec3 once = field_colour(open_field(Crop::ploughed), 0.0F, 0.0F, 0.0F, 1.0F);
  expect_near(field_colour(open_field(Crop::ploughed), 0.0F, 0.0F, 0.0F, 2.0F),
              1.0F + 2.0F * (once - 1.0F));
}

}  // namespace
}  // namespace belvedere
