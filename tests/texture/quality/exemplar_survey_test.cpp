#include "texture/quality/exemplar_survey.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// Grey noise of contrast `left` and `right` of the centre, all one class; a guide with a gap.
Exemplar two_hands(int left, int right) {
  Exemplar exemplar;
  exemplar.name = "two hands";
  exemplar.picture = Grid<Rgb8>(160, 120);
  exemplar.guides.label = Grid<std::uint8_t>(160, 120, 4);
  exemplar.guides.guides = {{"altitude", Grid<std::uint8_t>(160, 120)}};
  for (const auto [x, y] : test::cells(160, 120)) {
    const int contrast = x < 80 ? left : right;
    const int grey =
        128 +
        static_cast<int>(random_index(static_cast<std::uint32_t>(2 * contrast + 1), 3, x, y)) -
        contrast;
    exemplar.picture(x, y).fill(static_cast<std::uint8_t>(grey));
    exemplar.guides.guides[0].values(x, y) =
        static_cast<std::uint8_t>(y < 60 ? 20 + y : 60 + y);  // 20…79, 120…179
  }
  return exemplar;
}

TEST(ExemplarSurvey, HalvesOfOneHandAreAlikeAndOfTwoAreNot) {
  const ClassSurvey even = survey_exemplar(two_hands(60, 60)).classes.at(0);
  EXPECT_EQ(even.texels, 160U * 120U);
  ASSERT_TRUE(even.left_right.known && even.checkerboard.known);
  EXPECT_LT(even.left_right.clique, 0.12);
  EXPECT_LT(even.checkerboard.clique, 0.12);
  const ClassSurvey uneven = survey_exemplar(two_hands(60, 10)).classes.at(0);
  EXPECT_GT(uneven.left_right.clique, 0.8);
  EXPECT_LT(uneven.checkerboard.clique, 0.12) << "squares of both styles are in both halves";
  // Uniform from -60 to 60 against -10 to 10: quantiles are off by 25 on average.
  EXPECT_NEAR(uneven.left_right.colour, 25.0, 1.5);
}

TEST(ExemplarSurvey, GuidesAreToldWithTheirGaps) {
  const ClassSurvey of = survey_exemplar(two_hands(60, 60)).classes.at(0);
  ASSERT_EQ(of.guides.size(), 1U);
  const GuideTexels& altitude = of.guides[0];
  EXPECT_EQ(altitude.lowest, 20);
  EXPECT_EQ(altitude.highest, 179);
  EXPECT_EQ(altitude.low, 26);  // 5 % of 120 rows
  EXPECT_EQ(altitude.high, 173);
  ASSERT_EQ(altitude.gaps.size(), 1U);
  EXPECT_EQ(altitude.gaps[0].from, 80);
  EXPECT_EQ(altitude.gaps[0].to, 119);
}

TEST(ExemplarSurvey, CountsWhatIsExcludedAndWhatLiesInside) {
  Exemplar exemplar = two_hands(60, 60);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 20; ++x) exemplar.guides.label(x, y) = unused_label;
    for (int x = 150; x < 160; ++x)
      exemplar.guides.label(x, y) = 9;  // all within 8 pixels of a border
  }
  const ExemplarSurvey survey = survey_exemplar(exemplar);
  EXPECT_EQ(survey.texels, 19200U);
  EXPECT_EQ(survey.excluded, 2400U);
  ASSERT_EQ(survey.classes.size(), 2U);
  EXPECT_EQ(survey.classes[0].label, 4);
  EXPECT_GT(survey.classes[0].sharpness, 10.0);
  EXPECT_EQ(survey.classes[1].label, 9);
  EXPECT_EQ(survey.classes[1].texels, 1200U);
  EXPECT_EQ(survey.classes[1].inside, 120U);  // the last column, 9 pixels off
  EXPECT_FALSE(survey.classes[1].left_right.known);
}

TEST(ExemplarSurvey, TellsHowManyPixelsFindTexelsOfTheirAltitude) {
  const std::vector<Exemplar> exemplars{two_hands(60, 60)};  // 20…79, 120…179
  GuideStack target;
  target.label = Grid<std::uint8_t>(200, 1, 4);
  target.guides = {{"altitude", Grid<std::uint8_t>(200, 1)}};
  for (int x = 0; x < 200; ++x) target.guides[0].values(x, 0) = static_cast<std::uint8_t>(x);
  const auto covered = [&](int reach) {
    return fit_guides(exemplars, target, 4, reach).at(0).covered;
  };
  EXPECT_EQ(covered(0), 120.0 / 200.0);
  EXPECT_EQ(covered(3), 132.0 / 200.0);
  EXPECT_EQ(covered(40), 1.0);
  // Distances from the nearest texel: 20 … 1 below, 1 … 20 … 1 in the gap of 40 values, 1 … 20
  // above; Σ k² for k = 1 … 20 is 2870.
  EXPECT_EQ(fit_guides(exemplars, target, 4, 0).at(0).square, 4 * 2870.0 / 200.0);
  EXPECT_TRUE(fit_guides(exemplars, target, 5, 0).empty()) << "no texel of that class";
  target.guides[0].name = "tone";
  EXPECT_TRUE(fit_guides(exemplars, target, 4, 0).empty());
}

// What a guide explains: all of the step between two halves, and of their contrast, and nothing of
// noise.
TEST(ExemplarSurvey, GuidesExplainThePaintThatFollowsThem) {
  Exemplar exemplar = two_hands(40, 40);
  Guide half{"half", Grid<std::uint8_t>(160, 120)};
  Guide chance{"chance", Grid<std::uint8_t>(160, 120)};
  for (const auto [x, y] : test::cells(160, 120)) {
    half.values(x, y) = x < 80 ? 0 : 255;
    chance.values(x, y) = static_cast<std::uint8_t>(random_index(256, 21, x / 8, y / 8));
  }
  Exemplar hands = two_hands(40, 10);
  hands.guides.guides = {half};
  exemplar.guides.guides = {half, chance};
  for (const auto [x, y] : test::cells(160, 120))
    if (x < 80)
      for (std::uint8_t& c : exemplar.picture(x, y)) c = static_cast<std::uint8_t>(c - 60);
  const std::vector<GuideShare> shares = explain_paint({exemplar});
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_EQ(shares[0].name, "half");
  EXPECT_GT(shares[0].explained, 0.95);
  // Two values 255 apart in equal numbers: 2 × 127.5² × 300 / 299 blocks.
  EXPECT_NEAR(shares[0].difference, 32512.5 * 300.0 / 299.0, 0.1);
  EXPECT_LT(shares[1].explained, 0.12);
  EXPECT_GT(explain_paint({hands}).at(0).explained, 0.9);
  // An exemplar without the guide takes no part, nor does one too small for a block.
  Exemplar without = two_hands(60, 10);
  without.guides.guides.clear();
  EXPECT_EQ(explain_paint({hands, without}).at(0).explained,
            explain_paint({hands}).at(0).explained);
  EXPECT_TRUE(explain_paint({without}).empty());
}

// Bars along a row, 12 pixels long and 1 high: their run is measured.
TEST(ExemplarSurvey, TellsHowLongStrokesAre) {
  Exemplar exemplar = two_hands(60, 60);
  for (const auto [x, y] : test::cells(160, 120))
    exemplar.picture(x, y).fill(
        static_cast<std::uint8_t>(random_index(2, 8, (x + 5 * y) / 12, y) == 0 ? 20 : 220));
  const double run = survey_exemplar(exemplar).classes.at(0).stroke_run_px;
  EXPECT_GT(run, 12.0);
  EXPECT_NEAR(mean_stroke_px({exemplar}), run, 1e-9);
  exemplar.guides.label = Grid<std::uint8_t>(160, 120, unused_label);
  EXPECT_EQ(mean_stroke_px({exemplar}), 0.0);
}

}  // namespace
}  // namespace belvedere
