#pragma once

#include <optional>

#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"
#include "renderer/style/style_parameters.h"

namespace belvedere {

// The style of a scene: `[style]` with its file and shares, or `style = "NAME"` alone.

// Reads the style that a scene names; nothing where it names none.
std::optional<Style> named_style(const LoadedScene& loaded);
// Reads the palette that a scene names; where it names none, that of its style.
Palette named_palette(const LoadedScene& loaded);

// Parameters for a sheet of that size, without those that depend on a view of the sheet
// (StyleSight).
StylePaintParameters to_style_parameters(const Scene& scene, double pixels_per_unit,
                                         glm::ivec2 sheet_px);

}  // namespace belvedere
