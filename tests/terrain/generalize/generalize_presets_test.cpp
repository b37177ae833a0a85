#include "terrain/generalize/generalize_presets.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "tests/terrain/generalize/synthetic_relief.h"

namespace belvedere {
namespace {

using test::Weights;

TEST(GeneralizePresets, AreFoundByTheirNamesAndSayWhatTheyDo) {
  std::set<std::string_view> names;
  for (const GeneralizePreset& preset : generalize_presets()) {
    EXPECT_EQ(find_generalize_preset(preset.name), &preset);
    EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    EXPECT_TRUE(preset.meaning.ends_with('.')) << preset.name;
  }
  EXPECT_EQ(find_generalize_preset("nothing"), nullptr);
  EXPECT_EQ(find_generalize_preset(""), nullptr);
}

TEST(GeneralizePresets, HaveAsManyWeightsInEachSetAsBands) {
  for (const GeneralizePreset& preset : generalize_presets()) {
    const GeneralizeParameters& bands = preset.bands;
    EXPECT_EQ(bands.background.size(), bands.foreground.size()) << preset.name;
    for (const Weights* sides : {&bands.foreground_ridges, &bands.foreground_valleys,
                                 &bands.background_ridges, &bands.background_valleys})
      EXPECT_TRUE(sides->empty() || sides->size() == bands.foreground.size()) << preset.name;
  }
}

// Jenny, Jenny & Hurni 2011, figures 2 and 5: the same weights, in figure 5 on steep ground only.
TEST(GeneralizePresets, AreThoseOfThePaper) {
  const GeneralizePreset& two = *find_generalize_preset("figure2");
  const GeneralizePreset& five = *find_generalize_preset("figure5");
  EXPECT_EQ(two.bands.foreground, (Weights{1.F, 1.F, 2.F, .25F, 0.F}));
  EXPECT_EQ(two.bands.background, two.bands.foreground);
  EXPECT_EQ(five.bands.foreground, two.bands.foreground);
  EXPECT_FALSE(two.slope_mask.has_value());
  EXPECT_TRUE(five.slope_mask.has_value());
}

TEST(GeneralizePresets, FillWhatIsNotWritten) {
  const auto choose = [](const WrittenWeights& written, const char* preset) {
    GeneralizeParameters bands;
    choose_weights(bands, written, find_generalize_preset(preset));
    return bands;
  };
  WrittenWeights written;
  written.foreground = {1.F, .5F, .5F, 1.F, 1.F, 1.F};
  EXPECT_EQ(choose(written, "").background, written.foreground);
  EXPECT_EQ(choose(written, "bold_ridges").background, written.foreground);
  EXPECT_EQ(choose(written, "bold_ridges").foreground_ridges,
            find_generalize_preset("bold_ridges")->bands.foreground_ridges);
  EXPECT_EQ(choose(written, "panorama").background,
            find_generalize_preset("panorama")->bands.background);
  written.background = {0.F, 0.F, 0.F, 0.F, 0.F, .5F};
  written.foreground_valleys = {0.F, 0.F, 0.F, 0.F, 1.F, 1.F};
  for (const char* preset : {"", "bold_ridges", "panorama"})
    EXPECT_EQ(choose(written, preset).background, written.background) << preset;
  EXPECT_EQ(choose(written, "").background_valleys, written.foreground_valleys);
  EXPECT_EQ(choose(written, "panorama").background_valleys,
            find_generalize_preset("panorama")->bands.background_valleys);
  WrittenWeights far;
  far.background = {1.F, 0.F};
  EXPECT_EQ(choose(far, "").foreground, (Weights{1.F, 1.F}));
  EXPECT_EQ(choose({}, "").foreground, Weights(6, 1.F));
}

}  // namespace
}  // namespace belvedere
