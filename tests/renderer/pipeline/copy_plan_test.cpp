#include "renderer/pipeline/copy_plan.h"

#include <gtest/gtest.h>

#include <cstdint>

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

}  // namespace
}  // namespace belvedere
