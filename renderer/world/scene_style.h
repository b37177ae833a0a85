#pragma once

#include <optional>

#include "renderer/paint/palette.h"
#include "renderer/scene/scene_file.h"
#include "renderer/style/style.h"

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

// The style with open ground under snow. Classes that the palette "winter" shows white take the
// style's snow, different from it as in that palette (OKLab), and the strokes of its snow; forest
// becomes darker or lighter as there. Sky, air, rock and water stay the painting's; twigs are those
// of the palette "winter".
Style winter_style(Style style);

}  // namespace belvedere
