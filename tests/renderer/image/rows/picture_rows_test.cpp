#include "renderer/image/rows/picture_rows.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "renderer/image/srgb.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

TEST(RowReducer, PixelsAreMeansOfWhatIsThere) {
  Image picture(5, 3);
  for (const auto [x, y] : test::cells(5, 3))
    picture(x, y) = glm::vec3(static_cast<float>(10 * y + x), 0.0F, static_cast<float>(x));
  RowReducer reducer(5, 3, 2);
  EXPECT_EQ(reducer.width(), 3);
  EXPECT_EQ(reducer.height(), 2);
  const Image small = reducer.reduce(picture);
  ASSERT_EQ(small.width(), 3);
  ASSERT_EQ(small.height(), 2);
  EXPECT_EQ(small(0, 0), glm::vec3(5.5F, 0.0F, 0.5F));
  EXPECT_EQ(small(1, 0), glm::vec3(7.5F, 0.0F, 2.5F));
  EXPECT_EQ(small(2, 0), glm::vec3(9.0F, 0.0F, 4.0F)) << "the right border: 2 pixels";
  EXPECT_EQ(small(0, 1), glm::vec3(20.5F, 0.0F, 0.5F)) << "the lower border: 2 pixels";
  EXPECT_EQ(small(2, 1), glm::vec3(24.0F, 0.0F, 4.0F)) << "the corner: 1 pixel";
}

TEST(RowReducer, RowsComeWhenTheyAreComplete) {
  Image picture(700, 10);
  for (const auto [x, y] : test::cells(700, 10))
    picture(x, y) = glm::vec3(static_cast<float>(random_uniform(1, x, y)));
  const Image whole = RowReducer(700, 10, 3).reduce(picture);
  ASSERT_EQ(whole.height(), 4);
  RowReducer reducer(700, 10, 3);
  int next = 0;
  for (int y = 0; y < 10; ++y) {
    Image row(700, 1);
    std::copy(picture.row(y), picture.row(y) + 700, row.data());
    const Image done = reducer.reduce(row);
    const bool complete = y % 3 == 2 || y == 9;
    ASSERT_EQ(done.height(), complete ? 1 : 0) << y;
    for (int x = 0; x < done.width(); ++x) ASSERT_EQ(done(x, 0), whole(x, next)) << "to the bit";
    next += complete ? 1 : 0;
  }
  EXPECT_EQ(next, 4);
}

TEST(RowReducer, AFactorOfOneChangesNothing) {
  const Image picture(4, 3, glm::vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(RowReducer(4, 3, 1).reduce(picture), picture);
}

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
