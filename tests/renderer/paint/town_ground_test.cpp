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
  expect_near(town_ground_colour(palette, street, 0.0F, 700.0, 0.6, 1.0F),
              glm::mix(street, lawn, 0.80F));
  expect_near(town_ground_colour(palette, street, 1.0F, 700.0, 0.6, 1.0F),
              glm::mix(street, lawn, 0.30F));
  EXPECT_EQ(town_ground_colour(palette, street, 5.0F, 700.0, 0.6, 1.0F),
            town_ground_colour(palette, street, 1.0F, 700.0, 0.6, 1.0F));
}

TEST(TownGround, LiesUnderSnowInWinter) {
  const Palette palette = read_palette("winter");
  const glm::vec3 snow = palette_colour(palette, LandCoverClass::snow, 700.0, 0.6 - 0.08);
  expect_near(town_ground_colour(palette, street, 0.0F, 700.0, 0.6, 1.0F),
              glm::mix(street, snow, 0.80F));
}

}  // namespace
}  // namespace belvedere
