#pragma once

#include "renderer/style/style_ground.h"

namespace belvedere {

// Where strokes of a style run: level as far as the painting's are, along the forms of light and
// dark, down the fall line; trees stand. In the sky level, or in swirls where the painting's are
// neither level nor at random. Doubled angles are summed, so that opposite directions are one.
// Reads fall_line, land_cover and depth_m, and ground.colour. Right beyond
// stroke_direction_margin_px from the window's edges that are not the sheet's.
Grid<glm::vec2> make_stroke_direction(const Style& style, const GuidanceBuffers& guidance,
                                      const Grid<glm::vec3>& lab,
                                      const StylePaintParameters& parameters, glm::ivec2 origin_px);
int stroke_direction_margin_px(const StylePaintParameters& parameters);

// Whether the strokes of a sky run in whorls.
bool has_whorls(const StyleBrushwork& sky);

// The brushwork a class is painted with: its own, or that of the nearest relative that the painting
// shows; lengths and widths capped. length_px 0: the style has none at all.
StyleBrushwork brushwork_of(const Style& style, LandCoverClass id);

}  // namespace belvedere
