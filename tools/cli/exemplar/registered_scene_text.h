#pragma once

#include <string>

#include "renderer/scene/scene.h"

namespace belvedere::tools {

// The sections of a scene file that a registration is about, and the lines of the land cover; all
// others are at their defaults.
std::string registered_scene_text(const Scene& scene);

}  // namespace belvedere::tools
