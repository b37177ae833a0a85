#pragma once

#include <string>
#include <vector>

#include "base/config.h"
#include "renderer/scene/scene.h"

namespace belvedere {

// Where a value of a scene was written: in its file or by a --set on the command line.
struct SceneOrigin {
  std::string file;                   // name of the scene file, for messages
  std::vector<std::string> settings;  // key=value, as given to --set

  // `file:line:column`, or `--set key=value`.
  std::string where(ConfigPosition position) const;
};

// The source position that marks a value as set by settings[index], and whether a position is one.
ConfigPosition place_of_setting(std::size_t index);
bool is_setting(ConfigPosition position);

// Applies every --set to the file's tables, in order: creates tables and list elements that are
// missing, and drops alternatives that the file sets (--set sun.azimuth=90 replaces the file's
// sun.time). Values are checked later, with the file's. Error(usage) for a setting without a key or
// with an invalid path.
void apply_settings(ConfigValue& root, const SceneOrigin& origin);
// The same for one value that is already parsed. Errors name its key, "deform.handles.0.move_m".
void set_scene_value(ConfigValue& root, const std::string& key, ConfigValue value);

// Expands the short form `style = "NAME"` at the top of a parsed scene to the table `[style]` with
// `file = "NAME"`.
void spread_style(ConfigValue& root);
// The same for the "key=value" of a --set.
std::string with_style_file(const std::string& setting);

// A picture of the same shape, at least 16 px high. The width of the sheet is unchanged, so strokes
// keep their size on it.
SceneOutput with_width(SceneOutput output, int width_px);

// A quick preview of a scene: the same sheet at a third of its pixels per side (rounded, at least
// 64, never more than the scene asks for), with one sample per pixel, a quarter of the sky
// directions, and all paint as strokes: no texture is painted or copied.
Scene make_draft(Scene scene);

}  // namespace belvedere
