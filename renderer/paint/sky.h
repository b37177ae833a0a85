#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "renderer/paint/clouds/clouds.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/picture_noise.h"
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

// The cloud deck of a front approaching from one side, seen from below: its lines start at the
// sky's vanishing point, its edge is ragged and bright. Caches lattice values: use one per thread.
class FrontDeck {
 public:
  FrontDeck(const SkyParameters& parameters, const SkyLook& look);
  struct Look {
    float cover = 0.0F;  // 0…1
    float light = 0.0F;  // 0 under the thick deck … 1 its bright edge
  };
  // At a position of the picture, px; empty near the horizon and below.
  Look at(double x_px, double y_px);

 private:
  const SkyParameters parameters_;
  const SkyLook look_;
  double side_;        // +1: the deck is right of its edge, -1 left
  double edge_slope_;  // of its edge: columns to the side per row above the vanishing point
  GroundNoise ragged_, torn_, folds_, fine_;
};

}  // namespace belvedere
