#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/scene/scene_schema.h"

namespace belvedere {

// One change of a scene file's text.
struct SceneEdit {
  std::string key;                   // as in --set: "sun.azimuth_deg", "deform.handles.0.move_m"
  std::optional<std::string> value;  // TOML of the value, "[0, 500]"; absent: the key, table or
                                     // list element is removed
  bool append = false;               // `key` names a list, and `value` is a new last element: of a
                                     // list of tables, { position = [0, 0], radius_m = 3000 }
};

// The text after all edits, in their order: list indices count what the edits before left.
// Comments, the order of lines and unknown keys stay. A missing key is added after the last one of
// its table, a missing table after those of its parent, else at the end. Alternatives of a key that
// is set are removed as by --set. A table whose last key is removed goes too, unless it has
// comments or, like [terrain.synthetic], a meaning of its own. Removing a missing key changes
// nothing.
//
// `name` is the file's name. Error(usage) where the text is not TOML (name:line:column) or an edit
// is impossible (its key); in particular, where the new text would not say exactly what --set says.
// Ranges and names are checked by parse_scene.
std::string edit_scene_text(const std::string& text, const std::string& name,
                            std::span<const SceneEdit> edits);

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
