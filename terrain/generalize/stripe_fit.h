#pragma once

#include "base/grid.h"

namespace belvedere {

// The regressor of a stripe's error: a constant, or the slope of the terrain along or across the
// stripe.
enum class Follows { offset, slope_along, slope_across };

// Stripes that run nearly along rows.
struct StripeLines {
  Follows follows = Follows::offset;
  double tilt = 0.0;                 // rows per column
  float longest_period_cells = 6.F;  // across the stripes
  float length_cells = 160.F;        // over which a stripe is constant
};

// Factor of a stripe's error at a cell: 1, or the slope in m per cell.
float followed(const Grid<float>& smooth_m, Follows follows, int x, int y);

// The stripes' error at every cell, in m, or in cells if it follows a slope: error · followed() is
// the error of the altitudes. `height_m`: detail across the lines, narrower than the longest
// period; `smooth_m`: the terrain whose slope is followed. All grids are of one size, cells finite.
Grid<float> fit_stripes(const Grid<float>& altitude_m, const Grid<float>& height_m,
                        const Grid<float>& smooth_m, const StripeLines& lines);

}  // namespace belvedere
