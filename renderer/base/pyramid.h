#pragma once

#include <vector>

#include "renderer/base/grid.h"

namespace belvedere {

// Gaussian and Laplacian pyramids (Burt & Adelson 1983) with the 5-tap kernel [.05 .25 .4 .25 .05] (requirements G02, G03).
// Any grid size: a level of n cells has a coarser level of (n + 1) / 2, whose cell i lies over cell 2 i. Level 0 is the finest.
// Borders are extended linearly (2·edge - inner), because replication bends a ramp when band weights differ from 1.

// What `level` looks like at half the size.
Grid<float> reduce(const Grid<float>& level);
// A coarser level brought to width × height, which must reduce to the coarser level's size.
Grid<float> expand(const Grid<float>& coarser, int width, int height);

struct LaplacianPyramid {
  std::vector<Grid<float>> bands;  // bands[0] is the finest: G_i - expand(G_{i+1})
  Grid<float> base;                // the coarsest Gaussian level
};

// `bands` bands or fewer, where the grid becomes smaller than 2 cells on a side.
LaplacianPyramid make_laplacian_pyramid(const Grid<float>& values, int bands);
// Equation 1: the base and all bands summed up; identical to the input up to float rounding.
Grid<float> reconstruct(const LaplacianPyramid& pyramid);
// The Gaussian levels of a mask or weight, level 0 first; `levels` of them.
std::vector<Grid<float>> make_gaussian_pyramid(const Grid<float>& values, int levels);

}  // namespace belvedere
