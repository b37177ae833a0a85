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
// Error(usage) for an unknown name.
RenderingIntent rendering_intent(const std::string& name);

// An sRGB profile (ICC 4) made by lcms2, for embedding. The same bytes every time: its date is
// fixed.
std::vector<std::uint8_t> srgb_profile();
// RGB spaces that need no file: "srgb", "display-p3" (SMPTE EG 432-1 primaries, D65, the curve of
// sRGB), "adobe-rgb" (Adobe RGB (1998)).
std::vector<std::string> colour_space_names();
// The ICC profile of one, the same bytes every time. Error(usage) for an unknown name.
std::vector<std::uint8_t> colour_space_profile(const std::string& name);

}  // namespace belvedere
