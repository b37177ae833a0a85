#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/guidance_buffers.h"

namespace belvedere {

// The channels of a guidance file, by their names in the file ("Z", "landcover.id"); nothing: all
// of them. A vector is included whole: one of its components names it.
using GuidanceChoice = std::optional<std::vector<std::string>>;

// "Z,landcover.id", or "none" for no file. Error(usage) listing the available channels.
GuidanceChoice read_guidance_choice(const std::string& text);
// Empties the channels that are not chosen.
void keep_chosen(GuidanceBuffers& guidance, const GuidanceChoice& choice);

}  // namespace belvedere
