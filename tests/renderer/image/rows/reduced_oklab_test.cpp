#include "renderer/image/rows/reduced_oklab.h"

#include <gtest/gtest.h>

#include "renderer/image/oklab.h"

namespace belvedere {
namespace {

TEST(ReducedOklab, OfItsOwnSizeIsThePictureInOklab) {
  Grid<glm::vec3> picture(3, 2, glm::vec3(0.2F, 0.5F, 0.7F));
  picture(2, 1) = glm::vec3(1.F, 0.F, 0.3F);
  const Grid<glm::vec3> out = reduced_oklab(picture, {3, 2});
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_EQ(out[i], glm::vec3(to_oklab(picture[i])));
}

TEST(ReducedOklab, TakesTheMeanOfThePixelsThatItTouches) {
  Grid<glm::vec3> picture(5, 1);
  for (int x = 0; x < 5; ++x) picture(x, 0) = glm::vec3(0.2F * static_cast<float>(x));
  const Grid<glm::vec3> out = reduced_oklab(picture, {2, 1});
  EXPECT_NEAR(out(0, 0).x, to_oklab(glm::vec3(0.2F)).x, 1e-6);  // 0, .2, .4
  EXPECT_NEAR(out(1, 0).x, to_oklab(glm::vec3(0.6F)).x, 1e-6);  // .4, .6, .8
}

}  // namespace
}  // namespace belvedere
