#include "tools/report/synthesis_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace belvedere::tools {
namespace {

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
