#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "terrain/generalize.h"
#include "terrain/mask.h"

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

}  // namespace belvedere
