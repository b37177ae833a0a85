#include "renderer/paint/town_ground.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>

#include "tests/renderer/paint/near_colours.h"
#include "texture/strokes/parcels.h"

namespace belvedere {
namespace {

using test::expect_near;

constexpr glm::vec3 street(0.5F, 0.4F, 0.3F);

TEST(TownGround, HasMoreGardensInAVillageThanInATown) {
  const Palette palette = read_palette("summer");
  const glm::vec3 lawn = crop_colour(Crop::grass) *
                         palette_colour(palette, LandCoverClass::valley_floor, 700.0, 0.6 - 0.08);
  expect_near(town_ground_colour(palette, street, 0.0F, 700.0, 0.6, 1.0F, 50.0F),
              glm::mix(street, lawn, 0.80F));
  expect_near(town_ground_colour(palette, street, 1.0F, 700.0, 0.6, 1.0F, 50.0F),
              glm::mix(street, lawn, 0.30F));
  EXPECT_EQ(town_ground_colour(palette, street, 5.0F, 700.0, 0.6, 1.0F, 50.0F),
            town_ground_colour(palette, street, 1.0F, 700.0, 0.6, 1.0F, 50.0F));
}

// Where villages are drawn house by house, a place reads as one pale patch with a soft edge.
TEST(TownGround, IsPaleAroundHousesThatAreDrawnOneByOne) {
  const Palette palette = read_palette("summer");
  const auto at = [&](float built, float metres_per_unit) {
    return town_ground_colour(palette, street, built, 700.0, 0.6, 1.0F, metres_per_unit);
  };
  const glm::vec3 pale = glm::vec3(0.74F, 0.70F, 0.60F) * (0.55F + 0.60F * 0.6F);
  expect_near(at(0.4F, 8.0F), glm::mix(at(0.4F, 50.0F), pale, 0.35F));
  EXPECT_EQ(at(0.01F, 8.0F), at(0.01F, 50.0F)) << "single houses stand in meadows";
  expect_near(at(0.10F, 8.0F), glm::mix(at(0.10F, 50.0F), pale, 0.35F * 0.5F));
}

TEST(TownGround, LiesUnderSnowInWinter) {
  const Palette palette = read_palette("winter");
  const glm::vec3 snow = palette_colour(palette, LandCoverClass::snow, 700.0, 0.6 - 0.08);
  expect_near(town_ground_colour(palette, street, 0.0F, 700.0, 0.6, 1.0F, 50.0F),
              glm::mix(street, snow, 0.80F));
}

}  // namespace
}  // namespace belvedere
