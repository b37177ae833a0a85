#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "terrain/generalize/generalize.h"
#include "terrain/generalize/mask.h"

namespace belvedere {

// Weights by name. They are meant for alpine terrain of 20–50 m cells; on others the bands move (see GeneralizeParameters).
struct GeneralizePreset {
  std::string_view name;
  std::string_view meaning;  // a line for the documentation
  GeneralizeParameters bands;
  std::optional<SlopeRange> slope_mask;
  bool automatic_mask = false;
};
const std::vector<GeneralizePreset>& generalize_presets();
// Null where there is none of that name.
const GeneralizePreset* find_generalize_preset(std::string_view name);

// The sets of weights that somebody wrote; those nobody wrote are empty.
struct WrittenWeights {
  std::vector<float> foreground, foreground_ridges, foreground_valleys;
  std::vector<float> background, background_ridges, background_valleys;
};
// The sets of `bands` as scenes and commands understand them. What is written has the last word; the rest is the preset's (null: none,
// weights of 1). A background set nobody wrote is as the foreground set is written, unless the preset has two different ones.
void choose_weights(GeneralizeParameters& bands, const WrittenWeights& written, const GeneralizePreset* preset);

}  // namespace belvedere
