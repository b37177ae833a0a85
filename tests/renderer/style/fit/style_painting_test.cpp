#include "renderer/style/fit/style_painting.h"

#include <gtest/gtest.h>

#include "tests/grids.h"
#include "tests/renderer/style/synthetic_painting.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

using enum LandCoverClass;
using test::label_of;

// Rock and snow side by side; a tenth of the pixels drawn as rock has the colour of snow.
TEST(CleanMask, LeavesOutWhatLooksLikeAnotherClass) {
  Grid<glm::vec3> lab(120, 80);
  Grid<std::uint8_t> drawn(120, 80);
  for (const auto [x, y] : test::cells(120, 80)) {
    drawn(x, y) = label_of(x < 80 ? rock : snow);
    const bool white = x >= 80 || (x >= 20 && x < 40 && y >= 20 && y < 52);
    lab(x, y) = white ? glm::vec3(0.9F, 0.0F, 0.0F) : glm::vec3(0.5F, 0.02F, 0.04F);
    lab(x, y).x += 0.03F * static_cast<float>(random_uniform(3, x, y));
  }
  const Grid<std::uint8_t> clean = clean_mask(lab, drawn);
  EXPECT_EQ(clean(30, 36), unused_label);
  EXPECT_EQ(clean(60, 40), label_of(rock));
  EXPECT_EQ(clean(100, 40), label_of(snow));
}

// Rock that is half yellow, half grey is kept whole if no other class is grey.
TEST(CleanMask, KeepsWhatIsOnlyUnlikeTheRestOfItsClass) {
  Grid<glm::vec3> lab(120, 80);
  Grid<std::uint8_t> drawn(120, 80);
  for (const auto [x, y] : test::cells(120, 80)) {
    drawn(x, y) = label_of(x < 80 ? rock : forest);
    lab(x, y) = x < 40   ? glm::vec3(0.6F, 0.0F, 0.0F)
                : x < 80 ? glm::vec3(0.6F, 0.02F, 0.10F)
                         : glm::vec3(0.3F, -0.05F, 0.05F);
  }
  EXPECT_EQ(clean_mask(lab, drawn), drawn);
}

TEST(CleanMask, ClassesOfFewTexelsAreLeftOutSkyAndFarAirStay) {
  Grid<glm::vec3> lab(60, 40, glm::vec3(0.5F, 0.0F, 0.0F));
  Grid<std::uint8_t> drawn(60, 40, label_of(rock));
  for (int x = 0; x < 60; ++x) {
    drawn(x, 0) = label_of(sky);
    drawn(x, 1) = far_air_label;
    drawn(x, 2) = label_of(snow);
  }
  const Grid<std::uint8_t> clean = clean_mask(lab, drawn);
  EXPECT_EQ(clean(5, 0), label_of(sky));
  EXPECT_EQ(clean(5, 1), far_air_label);
  EXPECT_EQ(clean(5, 2), unused_label);
  EXPECT_EQ(clean(5, 20), label_of(rock));
}

}  // namespace
}  // namespace belvedere
