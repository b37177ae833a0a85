#pragma once

#include "base/guidance_buffers.h"
#include "renderer/style/style_parameters.h"

namespace belvedere {

// The painting's sky: a grid of its colours, softened, and on it the two ways in which its colour
// mostly changes, as noise with the painting's lengths and its distribution. Everything is a
// function of the place on the sheet.

// Lays it, in OKLab, over the sky pixels of a window whose top-left pixel is `origin_px`.
void paint_style_sky(Grid<glm::vec3>& lab, const Style& style, const GuidanceBuffers& guidance,
                     const StylePaintParameters& parameters, glm::ivec2 origin_px);

// Amount of a change whose normal deviate is `normal`, by its quantiles (of normal deviates at
// shares .02 … .98), straight between and level beyond them.
double shaped_amount(const StyleSkyChange& change, double normal);

}  // namespace belvedere
