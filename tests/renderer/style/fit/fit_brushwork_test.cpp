#include "renderer/style/fit/fit_brushwork.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/grids.h"
#include "tests/renderer/style/synthetic_painting.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

using test::label_of;

constexpr auto rock_index = static_cast<std::size_t>(LandCoverClass::rock);

StyleBrushwork rock_brushwork(const Grid<glm::vec3>& lab) {
  return fit_brushwork(lab, Grid<std::uint8_t>(lab.width(), lab.height(),
                                               label_of(LandCoverClass::rock)))[rock_index];
}

// Two points at distance s lie in one stroke with probability (l - s) / (l + s): half at a third of
// l.
TEST(FitBrushwork, MeasuresTheLengthAndWidthOfThrownStrokes) {
  for (const double angle : {0.0, 0.5 * std::numbers::pi, 0.4}) {
    const StyleBrushwork b = rock_brushwork(test::thrown_strokes(240, 200, 15.0, 4.0, angle));
    EXPECT_NEAR(b.length_px, 15.0, 0.25 * 15.0) << angle;
    EXPECT_NEAR(b.width_px, 4.0, 0.8) << angle;
    EXPECT_NEAR(b.level, std::cos(2.0 * angle), 0.12) << angle;
    EXPECT_GT(b.coherence, 0.5) << angle;
  }
}

TEST(FitBrushwork, SteadinessTellsOnWhatScaleStrokesOfASkyTurn) {
  const auto sky_of = [](const Grid<glm::vec3>& lab) {
    return fit_brushwork(
               lab, Grid<std::uint8_t>(lab.width(), lab.height(), label_of(LandCoverClass::sky)))
        .at(static_cast<std::size_t>(LandCoverClass::sky));
  };
  const StyleBrushwork steady = sky_of(test::thrown_strokes(240, 200, 15.0, 4.0, 0.4));
  for (const double share : steady.steadiness) EXPECT_GT(share, 0.85);
  // Squares of 40 px, alternately level and upright.
  const Grid<glm::vec3> level = test::thrown_strokes(240, 200, 15.0, 4.0, 0.0);
  Grid<glm::vec3> turning = test::thrown_strokes(240, 200, 15.0, 4.0, 0.5 * std::numbers::pi);
  for (const auto [x, y] : test::cells(240, 200))
    if ((x / 40 + y / 40) % 2 == 0) turning(x, y) = level(x, y);
  const StyleBrushwork swirls = sky_of(turning);
  EXPECT_GT(swirls.steadiness[0], 0.6);
  EXPECT_LT(swirls.steadiness[2], 0.25);
  EXPECT_EQ(rock_brushwork(level).steadiness[0], 0.0);
}

TEST(FitBrushwork, LongerStrokesMeasureLongerUpToTheLimit) {
  const StyleBrushwork shorter = rock_brushwork(test::thrown_strokes(200, 160, 9.0, 3.0, 0.0));
  const StyleBrushwork longer = rock_brushwork(test::thrown_strokes(200, 160, 13.0, 3.0, 0.0));
  EXPECT_LT(shorter.length_px, longer.length_px);
  const StyleBrushwork hairs = rock_brushwork(test::thrown_strokes(240, 160, 120.0, 12.0, 0.0));
  EXPECT_EQ(hairs.length_px, 20.0);
  EXPECT_EQ(hairs.width_px, 5.0);
}

// Vertical ridges of sigma 8 px with strokes along them.
TEST(FitBrushwork, FormIsTheAgreementWithLargerForms) {
  Grid<glm::vec3> along =
      test::thrown_strokes(240, 200, 12.0, 3.0, 0.5 * std::numbers::pi, 0.6, 0.06);
  Grid<glm::vec3> across = test::thrown_strokes(240, 200, 12.0, 3.0, 0.0, 0.6, 0.06);
  for (Grid<glm::vec3>* lab : {&along, &across})
    for (const auto [x, y] : test::cells(240, 200))
      (*lab)(x, y).x += 0.12F * static_cast<float>(std::sin(2.0 * std::numbers::pi * x / 60.0));
  EXPECT_GT(rock_brushwork(along).form, 0.8);
  EXPECT_LT(rock_brushwork(across).form, -0.3);
}

TEST(FitBrushwork, ResidualsHaveTheSpreadOfTheStrokesAndNoMean) {
  const StyleBrushwork b =
      rock_brushwork(test::thrown_strokes(240, 200, 12.0, 4.0, 0.0, 0.6, 0.12));
  // Uniform within ± .12, reduced by the local mean and the blur.
  EXPECT_NEAR(b.lightness_deviation, 0.12 / std::sqrt(3.0), 0.02);
  for (const std::vector<glm::vec3>& third : b.residuals) {
    ASSERT_EQ(third.size(), 64U);
    double sum = 0.0;
    for (const glm::vec3& residual : third) {
      sum += static_cast<double>(residual.x);
      EXPECT_LE(std::abs(residual.x), 2.2 * 0.12);
      EXPECT_NEAR(residual.y, 0.0, 1e-4);
    }
    EXPECT_NEAR(sum / 64.0, 0.0, 0.006);
  }
}

TEST(FitBrushwork, AccentsAreTheMostColourful) {
  Grid<glm::vec3> lab = test::thrown_strokes(120, 100, 10.0, 4.0, 0.0);
  for (const auto [x, y] : test::cells({40, 40, 70, 64}))
    lab(x, y) = {0.6F, 0.15F, 0.10F};  // 6 % of it
  const StyleBrushwork b = rock_brushwork(lab);
  ASSERT_EQ(b.accents.size(), 16U);
  for (const glm::vec3& accent : b.accents) EXPECT_GT(accent.y, 0.1F);
}

TEST(FitBrushwork, ClassesOfFewTexelsAndOfNoneHaveNoStrokes) {
  const Grid<glm::vec3> lab = test::thrown_strokes(100, 80, 10.0, 3.0, 0.0);
  Grid<std::uint8_t> mask(100, 80, unused_label);
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 5; ++y) mask(x, y) = label_of(LandCoverClass::rock);
  for (const StyleBrushwork& b : fit_brushwork(lab, mask)) EXPECT_EQ(b.length_px, 0.0);
}

}  // namespace
}  // namespace belvedere
