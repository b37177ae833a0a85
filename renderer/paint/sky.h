#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "renderer/paint/clouds/clouds.h"
#include "renderer/paint/palette.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"

namespace belvedere {

// Gradient at a position from the top of the picture (0) to the horizon (1); clamped. Encoded sRGB.
glm::vec3 sky_gradient(const Palette& palette, double position);
// Colour where there is no terrain: the sky, and below the horizon (position > 1) the haze of
// ground without data.
glm::vec3 air_beyond(const Palette& palette, double position);

// Encoded sRGB at the sky pixels of a part of the picture (depth +inf); other pixels hold 0. Pixels
// are independent of each other.
Grid<glm::vec3> make_sky(const Grid<float>& depth_m, const Palette& palette,
                         const SkyParameters& parameters, glm::ivec2 origin_px);

// Median over the columns of the topmost terrain row, `fallback_px` where no column has terrain:
// the horizon_px of pictures. Uses a few thousand rays in 64 columns, before anything else is
// traced. A column's skyline is searched from the top in steps of 1/96 of the height, so a needle
// between two steps may be missed, then bisected to a pixel.
double skyline_row_px(const Camera& camera, const Tracer& tracer, double fallback_px);

}  // namespace belvedere
