#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/scene/scene_schema.h"

namespace belvedere {

// The values of a scene as text. All but name tables are written alike in TOML and in JSON:
// { rock = 2 } and {"rock": 2}.
enum class ValueForm { toml, json };

// Empty where nothing is set.
std::string value_text(const SceneField& field, ValueForm form = ValueForm::toml);

// Every key in effect, defaults included, in the order of the reference: "camera.height_m" and
// "22000", "deform.handles.0.move_m" and "[0, 500]". What is unset, or excluded by another key, is
// missing; so are the keys of another `section` if one is named: "camera", "deform.handles.0".
std::vector<std::pair<std::string, std::string>> scene_values(Scene scene,
                                                              ValueForm form = ValueForm::json,
                                                              std::string_view section = "");

}  // namespace belvedere
