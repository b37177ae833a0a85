#include "renderer/pipeline/copy_plan.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/geometric.hpp>

#include "base/random.h"
#include "renderer/exemplar/example_sheet.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

TEST(CopyPlan, WhatASceneSaysOfOneGuideLeavesTheOthers) {
  const SynthesisParameters usual = to_synthesis_parameters(test::small_scene().scene);
  const SynthesisParameters given =
      to_synthesis_parameters(test::small_scene({"synthesis.weights={ tone = 3 }"}).scene);
  ASSERT_EQ(usual.weights.size(), given.weights.size());
  for (std::size_t i = 0; i < usual.weights.size(); ++i) {
    EXPECT_EQ(usual.weights[i].first, given.weights[i].first);
    EXPECT_EQ(given.weights[i].second,
              given.weights[i].first == "tone" ? 3.0 : usual.weights[i].second);
  }
}

TEST(CopyPlan, AFallbackOfTheSceneStandsInForAClass) {
  const SynthesisParameters given =
      to_synthesis_parameters(test::small_scene({"synthesis.fallback={ rock = \"water\" }"}).scene);
  EXPECT_EQ(given.fallback.at(static_cast<std::uint8_t>(LandCoverClass::rock)),
            static_cast<std::uint8_t>(LandCoverClass::water));
}

TEST(CopyPlan, PatchesAndSurroundingsAreTheScenes) {
  const auto id = [](LandCoverClass of) { return static_cast<std::uint8_t>(of); };
  const SynthesisParameters usual = to_synthesis_parameters(test::small_scene().scene);
  EXPECT_EQ(usual.neighbourhood, 7);
  EXPECT_EQ(usual.surroundings, 1.0);
  EXPECT_EQ(usual.surroundings_of, "commonest");
  EXPECT_TRUE(usual.class_dissimilarity.empty());
  const SynthesisParameters given = to_synthesis_parameters(
      test::small_scene(
          {"synthesis.neighbourhood=9", "synthesis.surroundings=4",
           "synthesis.surroundings_of=\"all\"",
           "synthesis.class_dissimilarity={ \"forest/shrub\" = 0.25, \"snow/glacier\" = 0 }"})
          .scene);
  EXPECT_EQ(given.neighbourhood, 9);
  EXPECT_EQ(given.surroundings, 4.0);
  EXPECT_EQ(given.surroundings_of, "all");
  ASSERT_EQ(given.class_dissimilarity.size(), 2U);
  EXPECT_EQ((given.class_dissimilarity.at({id(LandCoverClass::forest), id(LandCoverClass::shrub)})),
            0.25);
  EXPECT_EQ((given.class_dissimilarity.at({id(LandCoverClass::snow), id(LandCoverClass::glacier)})),
            0.0);
  for (const char* wrong : {"synthesis.neighbourhood=6", "synthesis.neighbourhood=13",
                            "synthesis.class_dissimilarity={ \"forest\" = 0.25 }",
                            "synthesis.class_dissimilarity={ \"forest/cloud\" = 0.25 }",
                            "synthesis.class_dissimilarity={ \"forest/forest\" = 0.25 }",
                            "synthesis.class_dissimilarity={ \"forest/shrub\" = 1.5 }"})
    EXPECT_FALSE(test::usage_error([&] { test::small_scene({wrong}); }).empty()) << wrong;
}

// A painting in two halves, the right one lighter, with bars 12 pixels long; guides as named follow
// the halves, by 50 steps.
Exemplar halves(const std::vector<std::string>& guides) {
  Exemplar exemplar{.name = "painting.png", .picture = Grid<Rgb8>(160, 120), .guides = {}};
  exemplar.guides.label = Grid<std::uint8_t>(160, 120, 8);
  Guide half{"", Grid<std::uint8_t>(160, 120)};
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      half.values(x, y) = x < 80 ? 100 : 150;
      exemplar.picture(x, y).fill(static_cast<std::uint8_t>(
          (x < 80 ? 50 : 120) + (random_index(2, 8, (x + 5 * y) / 12, y) == 0 ? 0 : 60)));
    }
  for (const std::string& name : guides) {
    half.name = name;
    exemplar.guides.guides.push_back(half);
  }
  return exemplar;
}

double weight_of(const SynthesisParameters& parameters, const std::string& name) {
  for (const auto& [guide, weight] : parameters.weights)
    if (guide == name) return weight;
  return -1.0;
}

TEST(CopyPlan, WeightsAndPatchesFollowThePainting) {
  const Scene scene = test::small_scene().scene;
  const SynthesisParameters usual = to_synthesis_parameters(scene);
  Exemplar painting = halves({"distance", "valley", "tone"});
  const SynthesisParameters fitted = fit_to_paintings(scene, {painting}, silent_progress());
  // Values 50 apart in equal numbers: the mean square of the difference of two random
  // ones is 2 × 25² × 300 / 299, at 270 each.
  const double expected = 70000.0 / 270.0 / (1250.0 * 300.0 / 299.0);
  EXPECT_NEAR(weight_of(fitted, "distance"), expected, 1e-9);
  EXPECT_NEAR(weight_of(fitted, "valley"), expected, 1e-9);
  EXPECT_NEAR(weight_of(fitted, "tone"), expected, 1e-9);
  EXPECT_EQ(weight_of(fitted, "slope"), weight_of(usual, "slope")) << "the painting lacks it";
  EXPECT_EQ(fitted.neighbourhood, 9) << "strokes of 12 pixels and more";
  // What the scene says stays.
  const Scene said = test::small_scene({"synthesis.weights={ distance = 0.02, valley = 0 }",
                                        "synthesis.neighbourhood=5"})
                         .scene;
  const SynthesisParameters own = fit_to_paintings(said, {painting}, silent_progress());
  EXPECT_EQ(weight_of(own, "distance"), 0.02);
  EXPECT_EQ(weight_of(own, "valley"), 0.0);
  EXPECT_NEAR(weight_of(own, "tone"), expected, 1e-9);
  EXPECT_EQ(own.neighbourhood, 5);
  // The program's own sheet is copied as ever.
  painting.name = example_sheet_name;
  const SynthesisParameters sheet = fit_to_paintings(scene, {painting}, silent_progress());
  EXPECT_EQ(sheet.weights, usual.weights);
  EXPECT_EQ(sheet.neighbourhood, 7);
}

TEST(CopyPlan, AVeryFinePrintIsNoted) {
  const auto note = [](const std::vector<std::string>& settings) {
    return fine_print_note(test::small_scene(settings).scene);
  };
  EXPECT_EQ(note({"output.width=20000", "output.height=8000", "output.sheet_width_mm=1200"}), "");
  EXPECT_NE(note({"output.width=40000", "output.height=16000", "output.sheet_width_mm=1200"})
                .find("847 dpi"),
            std::string::npos);
  EXPECT_EQ(note({"output.width=40000", "output.height=16000", "output.sheet_width_mm=2400"}), "");
  // The texels of a painting were drawn for its own size.
  const std::string painting = "exemplar=[{ picture = \"p.tif\", classes = \"c.tif\" }]";
  EXPECT_EQ(
      note({"output.width=40000", "output.height=16000", "output.sheet_width_mm=1200", painting}),
      "");
}

// Rivers go with the painting's water, or with the ground that they run through.
TEST(WaterShift, IsThatOfThePaintedWaterOrOfTheGroundAroundIt) {
  const Palette summer = read_palette("summer");
  const auto paint = [&](ScannedPainting& scan, LandCoverClass id, glm::vec3 shift) {
    LabelRamps& ramps = scan.ramps[static_cast<std::size_t>(id)];
    ramps.distances = {0.0};
    ramps.texels = 100;
    ToneRamp ramp{};
    for (std::size_t t = 0; t < ramp.size(); ++t)
      ramp[t] = palette_colour(summer, id, 1500.0, ramp_tones[t]) + shift;
    ramps.ramps = {ramp};
  };
  EXPECT_EQ(water_shift(summer, {}), glm::vec3(0.F));
  std::vector<ScannedPainting> scans(1);
  paint(scans[0], LandCoverClass::water, {0.04F, -0.02F, -0.06F});
  paint(scans[0], LandCoverClass::snow, {-0.2F, -0.2F, -0.2F});
  const glm::vec3 of_water = water_shift(summer, scans);
  EXPECT_LT(glm::length(of_water - glm::vec3(0.04F, -0.02F, -0.06F)), 0.01F);
  scans[0].ramps[static_cast<std::size_t>(LandCoverClass::water)] = {};
  const glm::vec3 of_snow = water_shift(summer, scans);
  EXPECT_LT(glm::length(of_snow - glm::vec3(-0.2F)), 0.02F) << "nothing else is known";
  paint(scans[0], LandCoverClass::pasture, {0.05F, 0.02F, 0.F});
  const glm::vec3 of_ground = water_shift(summer, scans);
  EXPECT_LT(glm::length(of_ground - glm::vec3(0.05F, 0.02F, 0.F)), 0.01F);
  EXPECT_GT(of_ground.x, 0.F) << "not the snow's";
}

}  // namespace
}  // namespace belvedere
