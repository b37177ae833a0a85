#include "base/colour/hsv.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace belvedere {
namespace {

TEST(Hsv, HueSaturationValueAndBack) {
  EXPECT_EQ(to_hsv({1, 0, 0}), glm::dvec3(0, 1, 1));
  EXPECT_NEAR(to_hsv({0, .5, 0}).x, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(to_hsv({.25, .25, .5}).y, .5, 1e-12);
  EXPECT_EQ(to_hsv({.4, .4, .4}), glm::dvec3(0, 0, .4));
  for (int i = 0; i < 500; ++i) {
    glm::dvec3 rgb;
    for (int c = 0; c < 3; ++c) rgb[c] = random_uniform(1, i, c);
    const glm::dvec3 back = from_hsv(to_hsv(rgb));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], rgb[c], 1e-12);
  }
}

}  // namespace
}  // namespace belvedere
