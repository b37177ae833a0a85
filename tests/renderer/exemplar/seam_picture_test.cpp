#include "renderer/exemplar/seam_picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

// Light falling from left to right, under strokes of one texel that differ by ± contrast; left half
// label 1, right half label 2, where strokes differ `fainter` times less.
PaintedExemplar striped(float contrast, float fainter) {
  PaintedExemplar painted;
  painted.picture = painted.base = Grid<glm::vec3>(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      painted.base(x, y) = glm::vec3(0.3F + 0.4F * static_cast<float>(x) / 64.F);
      painted.picture(x, y) =
          painted.base(x, y) + (y % 2 == 0 ? contrast : -contrast) * (x < 32 ? 1.F : 1.F / fainter);
    }
  return painted;
}

Grid<std::uint8_t> halves() {
  Grid<std::uint8_t> labels(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) labels(x, y) = x < 32 ? 1 : 2;
  return labels;
}

int stripe_height(const Grid<Rgb8>& seams, int x) { return seams(x, 16)[0] - seams(x, 17)[0]; }

TEST(SeamPicture, LeavesTheLightOut) {
  const Grid<Rgb8> seams = seam_picture(striped(0.03F, 1.F), halves(), 1.0);
  for (int x = 1; x < 64; ++x) EXPECT_EQ(seams(x, 16), seams(0, 16)) << x;
  // Without a residual the light is part of what must match.
  const Grid<Rgb8> plain = seam_picture(striped(0.03F, 1.F), halves(), 0.0);
  EXPECT_GT(plain(31, 16)[0], plain(0, 16)[0] + 10);
}

TEST(SeamPicture, StretchesFaintStrokesToEqualContrast) {
  const Grid<Rgb8> seams = seam_picture(striped(0.03F, 3.F), halves(), 1.0);
  EXPECT_NEAR(stripe_height(seams, 10), stripe_height(seams, 50), 1);
  // ± .03 is a deviation of about 7.6 steps about the mean; it becomes 14.
  EXPECT_NEAR(stripe_height(seams, 10), 28, 2);
}

TEST(SeamPicture, NeverWeakensAndStretchesAtMostEightfold) {
  EXPECT_EQ(stripe_height(seam_picture(striped(0.2F, 1.F), halves(), 1.0), 10), 102);
  EXPECT_NEAR(stripe_height(seam_picture(striped(0.002F, 1.F), halves(), 1.0), 10), 0.004 * 8 * 255,
              1);
}

TEST(SeamPicture, WithoutABaseComparesThePictureItself) {
  PaintedExemplar scan = striped(0.03F, 1.F);
  const Grid<Rgb8> with_base = seam_picture(scan, halves(), 0.0);
  scan.base = {};
  EXPECT_EQ(seam_picture(scan, halves(), 0.75), with_base);
}

}  // namespace
}  // namespace belvedere
