#pragma once

#include "renderer/base/grid.h"

namespace belvedere {

// Slope and aspect by Horn (1981), as gdaldem; borders from the clamped neighbours. Cells in metres, rows north to south.
Grid<float> slope_deg(const Grid<float>& altitude_m, double cell_x_m, double cell_y_m);
// Clockwise from north, downhill; flat cells -1.
Grid<float> aspect_deg(const Grid<float>& altitude_m, double cell_x_m, double cell_y_m);

// Evans–Young plan curvature kp = -N/g³ (convex positive, 1/m) and the bounded form N/g²; formulas in requirements, section G.
Grid<float> plan_curvature(const Grid<float>& altitude_m, double cell_m);
Grid<float> bounded_plan_curvature(const Grid<float>& altitude_m, double cell_m);

// Height above the Gaussian mean: blur(inner_m) - blur(outer_m); 0 for inner_m means the cell itself.
Grid<float> relief(const Grid<float>& altitude_m, double cell_m, double inner_m, double outer_m);
// Height above the lowest ground (smoothed by one cell) within radius_m.
Grid<float> height_above_valley(const Grid<float>& altitude_m, double cell_m, double radius_m);

}  // namespace belvedere
