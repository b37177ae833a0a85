#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/image/icc/device_parameters.h"

namespace belvedere {

// The names of the intents.
struct RenderingIntentName {
  std::string_view name;
  RenderingIntent intent;
  std::string_view meaning;
};
const std::vector<RenderingIntentName>& rendering_intents();
std::vector<std::string> rendering_intent_names();
// Error(usage) for a name that is none.
RenderingIntent rendering_intent(const std::string& name);

// An sRGB profile (ICC 4) made by lcms2, for embedding. The same bytes every time: its date is fixed.
std::vector<std::uint8_t> srgb_profile();
// Spaces of RGB that need no file: "srgb", "display-p3" (SMPTE EG 432-1 primaries, D65, the curve of sRGB), "adobe-rgb" (Adobe RGB (1998)).
std::vector<std::string> color_space_names();
// The ICC profile of one, the same bytes every time. Error(usage) for a name that is none.
std::vector<std::uint8_t> color_space_profile(const std::string& name);

}  // namespace belvedere
