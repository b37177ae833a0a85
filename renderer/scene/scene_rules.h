#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "base/config.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/scene_settings.h"

namespace belvedere {

// Rules between several keys of a scene: keys that need each other, that must be ordered, that must
// have equal length. Fills in what follows from others (synthetic terrain where there is no
// source). `root`: the positions where the values were written. Throws Error(usage).
void apply_scene_rules(Scene& scene, const ConfigValue& root, const SceneOrigin& origin);

// The two classes that "forest/shrub" names; nothing unless it names two different classes.
std::optional<std::pair<LandCoverClass, LandCoverClass>> find_class_pair(std::string_view names);

}  // namespace belvedere
