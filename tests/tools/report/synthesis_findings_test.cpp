#include "tools/report/synthesis_findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/grids.h"
#include "texture/synthesis/match_cost.h"

namespace belvedere::tools {
namespace {

// A painting of 160 × 160 whose altitude is its column; a target of 128 × 128 that copies its left
// upper part, but for one square that copies one and the same texel, and asks for altitudes that
// are off by 10 in its right half.
class SynthesisFindingsTest : public ::testing::Test {
 protected:
  SynthesisFindingsTest() {
    Exemplar painting{.name = "p.png", .picture = Grid<Rgb8>(160, 160), .guides = {}};
    painting.guides.label = Grid<std::uint8_t>(160, 160, 1);
    Grid<std::uint8_t> columns(160, 160);
    for (const auto [x, y] : test::cells(160, 160)) {
      columns(x, y) = static_cast<std::uint8_t>(x);
      painting.picture(x, y) = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), 9};
    }
    painting.guides.guides.push_back({"altitude", columns});
    paintings_.push_back(std::move(painting));
    target_.label = Grid<std::uint8_t>(128, 128, 1);
    Grid<std::uint8_t> asked(128, 128);
    matches_ = MatchField(128, 128);
    for (const auto [x, y] : test::cells(128, 128)) {
      asked(x, y) = static_cast<std::uint8_t>(x < 64 ? x : x + 10);
      matches_(x, y) = {0, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)};
      if (x < 16 && y < 16) matches_(x, y) = {0, 3, 3};
    }
    target_.guides.push_back({"altitude", asked});
    target_.guides.push_back({"weightless", asked});
    parameters_.weights = {{"altitude", 2.0}};
  }
  SynthesisReportInput input() const {
    return {
        "t", "c", paintings_, target_, parameters_, matches_, [](std::uint8_t) { return "class"; }};
  }

  std::vector<Exemplar> paintings_;
  GuideStack target_;
  SynthesisParameters parameters_;
  MatchField matches_;
};

TEST_F(SynthesisFindingsTest, GuidesCostByTheSquareOfWhatTheyAreOff) {
  const Grid<float> cost = guide_cost_map(input(), "altitude");
  EXPECT_EQ(cost(40, 40), 0.F);
  EXPECT_EQ(cost(100, 40), guide_cost(10, 2.0));
  const SynthesisFindings found = look_at_synthesis(input(), silent_progress());
  ASSERT_EQ(found.guides.size(), 1U) << "only guides that the painting has too";
  // 10 in half of the pixels; in the square of 16 × 16 |x − 3|: 6 + 78 a row.
  EXPECT_NEAR(found.guides[0].error_mean, (10.0 * 64 * 128 + 84.0 * 16) / (128.0 * 128.0), 1e-9);
  EXPECT_EQ(found.guides[0].error_95, 10.F);
  EXPECT_EQ(found.guides[0].weight, 2.0);
}

TEST_F(SynthesisFindingsTest, TexelsThatServeManyAreFoundWithTheirPlace) {
  const SynthesisFindings found = look_at_synthesis(input(), silent_progress());
  EXPECT_EQ(found.use_counts(5, 5), 256.F);
  EXPECT_EQ(found.use_counts(50, 50), 1.F);
  bool seen = false;
  for (const Place& position : found.positions) {
    EXPECT_GE(position.window.x0, 0);
    EXPECT_LE(position.window.x1, 128);
    if (position.why == "texels used often" && position.window == PixelRect{0, 0, 64, 64})
      seen = true;
    if (position.why == "altitude off") {
      EXPECT_GE(position.window.x0, 64);
      EXPECT_NEAR(position.source.x0, position.window.x0, 1) << "all of it by one offset";
      EXPECT_NEAR(position.source.y0, position.window.y0, 1);
      EXPECT_EQ(position.piece, 64U * 64U);
    }
  }
  // The seams of the square take that window first: no window is listed twice.
  for (std::size_t i = 0; i < found.positions.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(found.positions[i].window == found.positions[k].window);
  EXPECT_TRUE(seen || found.positions.front().window == (PixelRect{0, 0, 64, 64}));
}

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const QualityFigure& figure(const std::vector<QualityFigure>& figures, const std::string& key) {
  return *std::find_if(figures.begin(), figures.end(),
                       [&](const QualityFigure& f) { return f.key == key; });
}

SynthesisQuality two_classes() {
  SynthesisQuality quality;
  quality.classes.resize(2);
  quality.classes[0] = {.label = 1, .sharpness = 1.2, .clique_distance = 0.05, .stroke_run = 0.0};
  quality.classes[1] = {.label = 2, .sharpness = 0.7, .clique_distance = 0.10, .stroke_run = 1.1};
  quality.label_agreement = 1.0;
  return quality;
}

TEST(SynthesisFigures, ClassesCountByTheirWorst) {
  const auto figures = key_figures(two_classes());
  EXPECT_EQ(figure(figures, "sharpness").value, 0.7) << "farther from 1 than 1.2";
  EXPECT_EQ(figure(figures, "clique_distance").value, 0.10);
  EXPECT_EQ(figure(figures, "stroke_run").value, 1.1) << "0 is not known";
}

TEST(SynthesisFigures, GoodIsWithinTheRange) {
  auto figures = key_figures(two_classes());
  EXPECT_TRUE(figure(figures, "label_agreement").good());
  EXPECT_FALSE(figure(figures, "sharpness").good());
  EXPECT_TRUE(figure(figures, "coverage").good()) << "any is";
  SynthesisQuality bad = two_classes();
  bad.excluded_used = 1;
  figures = key_figures(bad);
  EXPECT_FALSE(figure(figures, "excluded_used").good());
}

TEST(SynthesisFigures, SeamsBetweenPaintingsNeedTwo) {
  SynthesisQuality quality = two_classes();
  quality.exemplars = 1;
  const auto keys = [&] {
    std::string all;
    for (const QualityFigure& f : key_figures(quality)) all += f.key + " ";
    return all;
  };
  EXPECT_THAT(keys(), Not(HasSubstr("seams")));
  quality.exemplars = 2;
  EXPECT_THAT(keys(), AllOf(HasSubstr("seams_between"), HasSubstr("seams_within")));
}

TEST(SynthesisFigures, ClassesHaveTheirFiguresWithTheirVerdict) {
  const ClassTexels available{.label = 2, .texels = 10, .pixels = 900};
  const std::string json =
      class_table(two_classes(), {available},
                  [](std::uint8_t label) { return "class " + std::to_string(label); })
          .rows()
          .str();
  EXPECT_THAT(json, AllOf(HasSubstr("\"name\": \"class 2\""), HasSubstr("\"asked\": 900"),
                          HasSubstr("\"asked\": null")));
  EXPECT_THAT(json, AllOf(HasSubstr("\"value\": 0.7,\n      \"good\": false"),
                          HasSubstr("\"value\": null,\n      \"good\": true")))
      << "0 is not known";
}

}  // namespace
}  // namespace belvedere::tools
