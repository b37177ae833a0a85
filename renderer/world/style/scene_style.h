#pragma once

#include <optional>

#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"
#include "renderer/style/style_parameters.h"

namespace belvedere {

// A painter's style in a scene: `[style]` with its file and shares, or `style = "NAME"` alone.

// The style that a scene names, read; nothing where it names none.
std::optional<Style> named_style(const LoadedScene& loaded);
// The palette that a scene names; where it names none, its style's.
Palette named_palette(const LoadedScene& loaded);

// How it is painted on a sheet of that size, but for what only a look at the sheet tells.
StylePaintParameters to_style_parameters(const Scene& scene, double pixels_per_unit,
                                         glm::ivec2 sheet_px);

}  // namespace belvedere
