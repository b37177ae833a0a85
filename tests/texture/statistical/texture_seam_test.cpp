#include "texture/statistical/texture_seam.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "tests/texture/statistical/texture_crops.h"

namespace belvedere {
namespace {

// The meadow in other colours.
Grid<Rgb8> heath(int width, int height) {
  Grid<Rgb8> out = test::meadow_crop(width, height, 41);
  for (Rgb8& c : out)
    c = {static_cast<std::uint8_t>(std::min(255, c[0] + 50)), static_cast<std::uint8_t>(c[1] / 2),
         c[2]};
  return out;
}

Grid<Rgb8> side_by_side(const Grid<Rgb8>& left, const Grid<Rgb8>& right) {
  Grid<Rgb8> out(left.width() + right.width(), left.height());
  for (int y = 0; y < out.height(); ++y) {
    std::copy_n(left.row(y), left.width(), out.row(y));
    std::copy_n(right.row(y), right.width(), out.row(y) + left.width());
  }
  return out;
}

constexpr SeamParameters quick_seam{.band_px = 24, .types = 16, .seed = 3};

TEST(Seams, NothingOutsideOfTheBandChanges) {
  const Grid<Rgb8> left = test::meadow_crop(96, 64);
  const Grid<Rgb8> right = heath(80, 64);
  const Grid<Rgb8> with_seam = synthesize_texture_seam(left, right, quick_seam).picture;
  const Grid<Rgb8> hard = side_by_side(left, right);
  int changed = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 176; ++x) {
      if (x < 96 - 24 || x >= 96 + 24) {
        ASSERT_EQ(with_seam(x, y), hard(x, y)) << x << " " << y;
      } else {
        changed += with_seam(x, y) != hard(x, y) ? 1 : 0;
      }
    }
  EXPECT_GT(changed, 48 * 64 / 4);
}

// Results for paintings are in docs/textures.md; this meadow is smoother than textures made of it,
// so that some of the seam stays.
TEST(Seams, LittleOfTheSeamIsLeft) {
  const Grid<Rgb8> left = test::meadow_crop(96, 96, 7);
  for (const Grid<Rgb8>& right : {test::meadow_crop(96, 96, 8), heath(96, 96)}) {
    const double hard = seam_ratio(side_by_side(left, right), 96, 24);
    const double with_seam =
        seam_ratio(synthesize_texture_seam(left, right, quick_seam).picture, 96, 24);
    EXPECT_GT(hard, 1.8);
    EXPECT_LT(with_seam - 1.0, .3 * (hard - 1.0)) << "of " << hard;
  }
}

// In colours close to those of one side or the other.
TEST(Seams, NoColourOfNeither) {
  const Grid<Rgb8> left = test::meadow_crop(96, 64);
  const Grid<Rgb8> right = heath(96, 64);
  const Grid<Rgb8> with_seam = synthesize_texture_seam(left, right, quick_seam).picture;
  const Grid<Rgb8> known = side_by_side(left, right);
  int strange = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 96 - 24; x < 96 + 24; ++x) {
      int nearest = 1000;
      for (const Rgb8& c : known)
        nearest = std::min(nearest, std::max({std::abs(c[0] - with_seam(x, y)[0]),
                                              std::abs(c[1] - with_seam(x, y)[1]),
                                              std::abs(c[2] - with_seam(x, y)[2])}));
      strange += nearest > 16 ? 1 : 0;
    }
  EXPECT_LT(strange, 48 * 64 / 100);
}

// A picture cut in two has no seam to remove, and keeps every pixel.
TEST(Seams, ASeamThatNobodySeesIsLeft) {
  const Grid<Rgb8> whole = test::meadow_crop(160, 64);
  const SeamInput with_seam =
      synthesize_texture_seam(part_of(whole, {0, 0, 80, 64}), part_of(whole, {80, 0, 160, 64}), {});
  EXPECT_EQ(with_seam.picture, whole);
  EXPECT_EQ(with_seam.band_px, 0);
  EXPECT_LE(with_seam.before, unseen_seam);
  EXPECT_EQ(with_seam.after, with_seam.before);
}

// A larger step gets a wider band, as far as the pictures allow.
TEST(Seams, TheBandIsAsWideAsTheStepAsks) {
  const Grid<Rgb8> left = test::meadow_crop(240, 48);
  Grid<Rgb8> bright = heath(240, 48);
  for (Rgb8& c : bright)
    for (std::size_t i = 0; i < 3; ++i) c[i] = static_cast<std::uint8_t>(std::min(255, c[i] + 70));
  const SeamInput far = synthesize_texture_seam(left, bright, {.types = 16});
  EXPECT_GT(far.band_px, 40);
  EXPECT_LT(far.after, 1.3) << "of " << far.before;
  EXPECT_EQ(synthesize_texture_seam(left, test::meadow_crop(240, 48, 8), {.types = 16}).band_px,
            24);
  const SeamInput given = synthesize_texture_seam(left, bright, {.band_px = 110, .types = 16});
  EXPECT_EQ(given.band_px, 110);
}

TEST(Seams, SeamRatioOfKnownSteps) {
  Grid<Rgb8> ramp(41, 2);  // steps of 2, except for one of 6 before column 20
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 41; ++x)
      ramp(x, y) = {static_cast<std::uint8_t>(2 * x + (x >= 20 ? 4 : 0)), 0, 0};
  EXPECT_NEAR(seam_ratio(ramp, 20, 2), 3.0, 1e-9);
  EXPECT_NEAR(seam_ratio(ramp, 10, 2, 5), 1.0, 1e-9);
}

TEST(Seams, TheSameBitsForAnyThreadsAndClearErrors) {
  std::vector<Grid<Rgb8>> made;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    made.push_back(
        synthesize_texture_seam(test::meadow_crop(64, 48), heath(64, 48), quick_seam).picture);
  }
  EXPECT_EQ(made[0], made[1]);
  EXPECT_THROW(synthesize_texture_seam(test::meadow_crop(64, 48), heath(64, 50), quick_seam),
               Error);
  EXPECT_THROW(synthesize_texture_seam(test::meadow_crop(40, 64), heath(64, 64), quick_seam),
               Error);
}

}  // namespace
}  // namespace belvedere
