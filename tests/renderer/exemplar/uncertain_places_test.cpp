#include "renderer/exemplar/uncertain_places.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

TEST(UncertainPlaces, TrustIsADeviation) {
  Grid<float> trust(400, 1, 1.F);
  trust[1] = 0.5F;
  trust[2] = place_trust(10.0, 400);
  trust[3] = 0.F;
  const Grid<float> deviation = place_deviation(trust);
  EXPECT_EQ(deviation[0], 0.F);
  EXPECT_NEAR(deviation[1], 4.F, 1e-4F) << "a hundredth of the width";
  EXPECT_NEAR(deviation[2], 10.F, 1e-3F);
  EXPECT_GE(deviation[3], 399.F);
}

// A guide that rises to the right; left the places are exact, right they are not known at all.
TEST(UncertainPlaces, GuidesAreAveragesOfWhatTheirPlacesMayBe) {
  GuideStack guides;
  guides.label = Grid<std::uint8_t>(300, 40, 3);
  Grid<std::uint8_t> rise(300, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 300; ++x) {
      if (y >= 20) guides.label(x, y) = 5;
      rise(x, y) = static_cast<std::uint8_t>(y >= 20 ? 200 : x / 2);
    }
  guides.guides = {{"altitude", rise}, {"tone", rise}};
  Grid<float> deviation(300, 40, 0.F);
  for (int y = 0; y < 40; ++y)
    for (int x = 150; x < 300; ++x) deviation(x, y) = x < 200 ? 6.F : 1000.F;
  average_over_places(deviation, guides);
  const Grid<std::uint8_t>& averaged = guides.guides[0].values;
  for (int x = 0; x < 150; ++x) EXPECT_EQ(averaged(x, 10), x / 2) << x;
  EXPECT_NEAR(averaged(175, 10), 175 / 2, 1) << "the mean of a slope is its middle";
  EXPECT_NEAR(averaged(290, 10), 75, 25) << "the class's own mean, nearly";
  EXPECT_EQ(averaged(290, 30), 200) << "other classes do not count";
  EXPECT_EQ(guides.guides[1].values, rise) << "tone is combined with the paint instead";
}

TEST(UncertainPlaces, ClassesAreUsedWhereTheyAreCertain) {
  Grid<std::uint8_t> labels(120, 60, 3);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 120; ++x)
      if (x >= 100 || (y >= 28 && y < 32)) labels(x, y) = 5;  // a field, and a narrow road
  const Grid<std::uint8_t> exact = certain_labels(labels, Grid<float>(120, 60, 0.F));
  EXPECT_EQ(exact, labels);
  const Grid<std::uint8_t> certain = certain_labels(labels, Grid<float>(120, 60, 6.F));
  EXPECT_EQ(certain(50, 30), unused_label) << "a road that may lie elsewhere";
  EXPECT_EQ(certain(50, 10), 3);
  EXPECT_EQ(certain(112, 30), 5);
}

TEST(CertainSky, EndsThatFarAboveTheSkyline) {
  Grid<std::uint8_t> labels(2, 10, 0);
  for (int y = 6; y < 10; ++y) labels(0, y) = 7;
  const Grid<std::uint8_t> out = certain_sky(labels, 2);
  for (int y = 0; y < 10; ++y) {
    EXPECT_EQ(out(0, y), y < 4 ? 0 : y < 6 ? unused_label : 7) << y;
    EXPECT_EQ(out(1, y), 0) << "no ground below it";
  }
}

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
