#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "terrain/generalize/generalize.h"
#include "terrain/generalize/mask.h"

namespace belvedere {

// Named weights, designed for alpine terrain of 20–50 m cells; for other cell sizes the bands shift
// (see GeneralizeParameters).
struct GeneralizePreset {
  std::string_view name;
  std::string_view meaning;  // a line for the documentation
  GeneralizeParameters bands;
  std::optional<SlopeRange> slope_mask;
  bool automatic_mask = false;
};
const std::vector<GeneralizePreset>& generalize_presets();
// Null for an unknown name.
const GeneralizePreset* find_generalize_preset(std::string_view name);

// The sets of weights given by the user; the others are empty.
struct WrittenWeights {
  std::vector<float> foreground, foreground_ridges, foreground_valleys;
  std::vector<float> background, background_ridges, background_valleys;
};
// The sets for `bands` bands, for scenes and commands. Given weights override the preset's (null:
// no preset, weights of 1). A missing background set equals the foreground set, unless the preset
// has two different ones.
void choose_weights(GeneralizeParameters& bands, const WrittenWeights& written,
                    const GeneralizePreset* preset);

}  // namespace belvedere
