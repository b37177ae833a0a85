// The keys of [generalize]: their meaning, that they read back, what they refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/scene/scene_file.h"
#include "terrain/generalize/generalize_presets.h"
#include "tests/renderer/scene/written_scene.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Weights = std::vector<float>;

Scene generalize_scene(const std::string& text) { return test::scene_of("[generalize]\n" + text); }
std::string refused_generalize(const std::string& text) {
  return test::refused("[generalize]\n" + text);
}
Scene again(const Scene& scene) {
  return parse_scene(write_scene(scene), "again.toml", ".", {}).scene;
}

void expect_same(const SceneGeneralize& a, const SceneGeneralize& b) {
  EXPECT_EQ(a.preset, b.preset);
  EXPECT_EQ(a.bands.foreground, b.bands.foreground);
  EXPECT_EQ(a.bands.background, b.bands.background);
  EXPECT_EQ(a.bands.foreground_ridges, b.bands.foreground_ridges);
  EXPECT_EQ(a.bands.foreground_valleys, b.bands.foreground_valleys);
  EXPECT_EQ(a.bands.background_ridges, b.bands.background_ridges);
  EXPECT_EQ(a.bands.background_valleys, b.bands.background_valleys);
  EXPECT_EQ(a.bands.curvature, b.bands.curvature);
  EXPECT_EQ(a.bands.full_curvature, b.bands.full_curvature);
  EXPECT_EQ(a.bands.blur_cells, b.bands.blur_cells);
  EXPECT_EQ(a.bands.exponent, b.bands.exponent);
  EXPECT_EQ(a.bands.crest, b.bands.crest);
  EXPECT_EQ(a.bands.base, b.bands.base);
  EXPECT_EQ(a.foreground_to_m, b.foreground_to_m);
  EXPECT_EQ(a.background_from_m, b.background_from_m);
  EXPECT_EQ(a.print_detail_px, b.print_detail_px);
  EXPECT_EQ(a.mask_slope_deg, b.mask_slope_deg);
  EXPECT_EQ(a.automatic_mask, b.automatic_mask);
  EXPECT_EQ(a.mask, b.mask);
  EXPECT_EQ(a.mask_classes, b.mask_classes);
  EXPECT_EQ(a.keep_lakes, b.keep_lakes);
  EXPECT_EQ(a.destripe, b.destripe);
  EXPECT_EQ(a.line_integral, b.line_integral);
  EXPECT_EQ(a.valleys.width_m, b.valleys.width_m);
}

constexpr const char* every_generalize_key = R"(preset = "figure4"
foreground = [1.1, 0.9, 0.333333]
background = [1.3, 0.2, 0]
foreground_ridges = [0, 0.25, 1.5]
foreground_valleys = [0.1, -0.25, 0.7]
background_ridges = [0.2, 0.6, -5]
background_valleys = [0.05, 0, 5]
base = 0.9
foreground_to_m = 4000.5
background_from_m = 9000.25
print_detail_px = 2.25
curvature = "plan"
full_curvature = 0.4
blur_cells = 1.75
exponent = 0.6
mask_slope_deg = [3.5, 11]
automatic_mask = true
mask = "where.tif"
mask_classes = { valley_floor = 0.2, water = 0 }
crest = 0.4
keep_lakes = false
destripe = true
line_integral = true
widen_valleys_m = 350
)";

TEST(SceneGeneralizeKeys, EachArrivesWhereItIsMeant) {
  const SceneGeneralize read = generalize_scene(every_generalize_key).generalize;
  EXPECT_EQ(read.preset, "figure4");
  EXPECT_EQ(read.bands.foreground, (Weights{1.1F, .9F, .333333F}));
  EXPECT_EQ(read.bands.background, (Weights{1.3F, .2F, 0.F}));
  EXPECT_EQ(read.bands.foreground_ridges, (Weights{0.F, .25F, 1.5F}));
  EXPECT_EQ(read.bands.foreground_valleys, (Weights{.1F, -.25F, .7F}));
  EXPECT_EQ(read.bands.background_ridges, (Weights{.2F, .6F, -5.F}));
  EXPECT_EQ(read.bands.background_valleys, (Weights{.05F, 0.F, 5.F}));
  EXPECT_EQ(read.foreground_to_m, 4000.5);
  EXPECT_EQ(read.background_from_m, 9000.25);
  EXPECT_EQ(read.print_detail_px, 2.25);
  EXPECT_EQ(read.bands.curvature, CurvatureForm::plan);
  EXPECT_EQ(read.bands.full_curvature, .4F);
  EXPECT_EQ(read.bands.blur_cells, 1.75F);
  EXPECT_EQ(read.bands.exponent, .6F);
  EXPECT_EQ(read.bands.crest, .4F);
  EXPECT_EQ(read.bands.base, .9F);
  EXPECT_EQ(read.mask_slope_deg, (std::array{3.5, 11.0}));
  EXPECT_TRUE(read.automatic_mask);
  EXPECT_EQ(read.mask, "where.tif");
  ASSERT_EQ(read.mask_classes.size(), 2U);
  for (const auto& [name, share] : read.mask_classes)
    EXPECT_EQ(share, name == "water" ? 0.0 : 0.2) << name;
  EXPECT_FALSE(read.keep_lakes);
  EXPECT_TRUE(read.destripe);
  EXPECT_TRUE(read.line_integral);
  EXPECT_EQ(read.valleys.width_m, 350.F);
}

TEST(SceneGeneralizeKeys, WrittenReadBackTheSame) {
  const Scene scene = generalize_scene(every_generalize_key);
  expect_same(again(scene).generalize, scene.generalize);
  EXPECT_EQ(write_scene(again(scene)), write_scene(scene));
}

// Keys beside a preset keep precedence when the scene is written, also those that have the default
// without a preset.
TEST(SceneGeneralizeKeys, PresetsFillWhatIsNotWrittenAndReadBack) {
  for (const GeneralizePreset& preset : generalize_presets()) {
    SCOPED_TRACE(preset.name);
    const Scene scene = generalize_scene("preset = \"" + std::string(preset.name) + "\"\n");
    EXPECT_EQ(scene.generalize.bands.background, preset.bands.background);
    EXPECT_EQ(scene.generalize.bands.background_ridges, preset.bands.background_ridges);
    EXPECT_EQ(scene.generalize.automatic_mask, preset.automatic_mask);
    expect_same(again(scene).generalize, scene.generalize);
  }
  const Scene flat = generalize_scene("preset = \"figure5\"\nmask_slope_deg = [0, 0]\n");
  EXPECT_EQ(flat.generalize.mask_slope_deg, (std::array{0.0, 0.0}));
  expect_same(again(flat).generalize, flat.generalize);
  const Scene bold = generalize_scene(
      "preset = \"bold_ridges\"\nautomatic_mask = false\nforeground = [1, 1, 1, 1, 1, 1]\n");
  EXPECT_FALSE(bold.generalize.automatic_mask);
  expect_same(again(bold).generalize, bold.generalize);
}

TEST(SceneGeneralizeKeys, ABackgroundThatIsNotWrittenFollowsUnlessThePresetHasTwo) {
  const std::string six =
      "foreground = [1, 1, 1, 0.5, 0.5, 0.5]\nforeground_ridges = [0, 0, 0, 1, 1, 1]\n";
  const Scene same = generalize_scene("preset = \"smooth_slopes\"\n" + six);
  EXPECT_EQ(same.generalize.bands.background, same.generalize.bands.foreground);
  EXPECT_EQ(same.generalize.bands.background_ridges, same.generalize.bands.foreground_ridges);
  EXPECT_EQ(same.generalize.bands.background_valleys,
            find_generalize_preset("smooth_slopes")->bands.background_valleys);
  const Scene two = generalize_scene("preset = \"panorama\"\n" + six);
  EXPECT_EQ(two.generalize.bands.background, find_generalize_preset("panorama")->bands.background);
  EXPECT_EQ(two.generalize.bands.background_ridges,
            find_generalize_preset("panorama")->bands.background_ridges);
  for (const Scene& scene : {same, two}) expect_same(again(scene).generalize, scene.generalize);
}

TEST(SceneGeneralizeKeys, RefuseWhatCannotBe) {
  const std::string three = "foreground = [1, 1, 1]\n";
  for (const std::string set : {"background", "foreground_ridges", "foreground_valleys",
                                "background_ridges", "background_valleys"}) {
    EXPECT_THAT(refused_generalize(three + set + " = [1, 1]\n"),
                AllOf(HasSubstr("s.toml:4:"), HasSubstr(set + " has 2 weights")))
        << set;
    EXPECT_THAT(refused_generalize(three + set + " = [1, 1, 5.5]\n"), HasSubstr("… 5")) << set;
  }
  EXPECT_THAT(refused_generalize(three + "background_ridges = [0, 0, -5.5]\n"),
              HasSubstr("-5 … 5"));
  EXPECT_THAT(refused_generalize("foreground = [1, -0.1]\n"), HasSubstr("0 … 5"));
  // A preset brings six arrays; one of another length beside it fits none of them.
  EXPECT_THAT(refused_generalize("preset = \"smooth_slopes\"\nforeground = [1, 1]\n"),
              HasSubstr("6 weights"));
  EXPECT_THAT(refused_generalize("preset = \"figure9\"\n"),
              AllOf(HasSubstr("s.toml:3:"), HasSubstr("figure9"), HasSubstr("smooth_slopes")));
  EXPECT_THAT(refused_generalize("print_detail_px = 0.25\n"), HasSubstr("0.5 … 20"));
  EXPECT_THAT(refused_generalize("print_detail_px = 21\n"), HasSubstr("0 … 20"));
  EXPECT_THAT(refused_generalize("full_curvature = 0.0005\n"), HasSubstr("0.001 … 10"));
  EXPECT_THAT(refused_generalize("mask_slope_deg = [9, 9]\n"), HasSubstr("[flatter, steeper]"));
  EXPECT_THAT(refused_generalize("mask_classes = { valley_floor = 1.5 }\n"), HasSubstr("0 … 1"));
  EXPECT_THAT(refused_generalize("mask_classes = { moon = 1 }\n"), HasSubstr("moon"));
  EXPECT_THAT(refused_generalize("curvature = \"gauss\"\n"), HasSubstr("bounded"));
  EXPECT_THAT(refused_generalize("forground = [1]\n"), HasSubstr("forground"));
}

}  // namespace
}  // namespace belvedere
