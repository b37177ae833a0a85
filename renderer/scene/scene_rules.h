#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "base/config.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/scene_settings.h"

namespace belvedere {

// What no single key of a scene can say: keys that need each other, that must be in order, that are as many. Fills in what follows from
// others (a made-up terrain where there is no source). `root` is where the values were written. Throws Error(usage).
void apply_scene_rules(Scene& scene, const ConfigValue& root, const SceneOrigin& origin);

// The two classes that "forest/shrub" names; nothing where it names no two different ones.
std::optional<std::pair<LandCoverClass, LandCoverClass>> find_class_pair(std::string_view names);

}  // namespace belvedere
