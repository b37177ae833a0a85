#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/guidance_buffers.h"

namespace belvedere {

// Which channels a guidance file is to hold, by their names in the file ("Z", "landcover.id"); nothing: all of them. A vector goes whole:
// one of its components names it.
using GuidanceChoice = std::optional<std::vector<std::string>>;

// "Z,landcover.id", or "none" for none at all: then there is no file. Error(usage) naming the channels there are.
GuidanceChoice read_guidance_choice(const std::string& text);
// The channels that are not chosen become empty.
void keep_chosen(GuidanceBuffers& guidance, const GuidanceChoice& choice);

}  // namespace belvedere
