#pragma once

#include "base/guidance_buffers.h"
#include "renderer/style/style_parameters.h"

namespace belvedere {

// The painting's sky: a smoothed grid of its colours plus its two principal components of colour,
// as noise with the painting's correlation lengths and distribution. Everything is a function of
// the position on the sheet.

// Blends it, in OKLab, into the sky pixels of a window whose top-left pixel is `origin_px`.
void paint_style_sky(Grid<glm::vec3>& lab, const Style& style, const GuidanceBuffers& guidance,
                     const StylePaintParameters& parameters, glm::ivec2 origin_px);

// Maps a normal deviate to the amount of a change by its quantiles (at shares .02 … .98): linear
// between them, constant beyond.
double shaped_amount(const StyleSkyChange& change, double normal);

}  // namespace belvedere
