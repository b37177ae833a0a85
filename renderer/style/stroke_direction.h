#pragma once

#include "renderer/style/style_ground.h"

namespace belvedere {

// Unit directions of the strokes: a mix of level (as far as in the painting), along light and dark
// forms and down the fall line; forests have upright strokes. Sky strokes are level, or swirls
// where the painting's are coherent but not level. Doubled angles are summed, so that opposite
// directions count as equal. Reads fall_line, land_cover, depth_m and `lab`, which is
// StyleGround::colour. Exact from stroke_direction_margin_px inside those edges of the window that
// are not the sheet's.
Grid<glm::vec2> make_stroke_direction(const Style& style, const GuidanceBuffers& guidance,
                                      const Grid<glm::vec3>& lab,
                                      const StylePaintParameters& parameters, glm::ivec2 origin_px);
int stroke_direction_margin_px(const StylePaintParameters& parameters);

// Whether the strokes of a sky run in swirls.
bool has_swirls(const StyleBrushwork& sky);

// The brushwork of a class: its own, or that of the most closely related class that the painting
// shows. length_px 0: the style has no brushwork.
const StyleBrushwork& brushwork_of(const Style& style, LandCoverClass id);

}  // namespace belvedere
