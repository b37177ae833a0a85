#pragma once

#include <vector>

#include "renderer/base/grid.h"
#include "renderer/base/progress.h"

namespace belvedere {

// Weights of the Laplacian bands, lowest (coarsest) band first as in figure 2 of Jenny, Jenny & Hurni 2011. Bands go by the
// cells of the DEM at hand: with b1 the finest, b_i holds features of 2^(i-1) to 2^i cells, on a 30 m DEM 30–60 m for b1 and 1–2 km for
// b6. A DEM of other cells needs its weights moved by the logarithm of the cell sizes to look the same.
struct GeneralizeParameters {
  std::vector<float> foreground = {1.F, 1.F, 1.F, 1.F, 1.F, 1.F};  // 0…5; their number is the number of bands
  std::vector<float> background = {1.F, 1.F, 1.F, 1.F, 1.F, 1.F};  // as many as foreground
  // Sharpening of high crests (look/recipe.md): adds crest · high · clamp(b2 + b3 + .6 b4, 0, 60 m) · (1 - .2 (1 - foreground share)),
  // high = clamp((b5 + b6 + base - 1200 m) / 700 m, 0, 1), bands unweighted. 0 is off; 0…3.
  float crest = 0.F;
};

// Equations 1, 2 and 5: A' = G_1 + Σ w_i L_i with w_i = u w_fore + (1-u) w_back. `foreground_share` is u per cell (1 near, 0 far), made
// by the caller from the camera, and reduced through the same pyramid for coarser bands; empty means 1 everywhere.
// Cells of `keep` != 0 (lakes) keep their altitude exactly; empty: none. No step stands at their shore and none are left on a table
// above a lowered valley: as in equation 6 each band's weight returns to 1 towards them, by the mask's own Gaussian pyramid, the
// change still left in the lake is taken off the land around it, fading over 32 cells, and the rest off the last six.
// A DEM too small for all bands goes without the coarsest. Unit weights and no crest return the input exactly.
// Throws Error(usage) where the two sets of weights differ in number, Error(bug) where grids differ in size.
Grid<float> generalize(const Grid<float>& altitude_m, const Grid<float>& foreground_share, const Grid<unsigned char>& keep,
                       const GeneralizeParameters& parameters, Progress& progress);

}  // namespace belvedere
