#pragma once

#include "base/grid.h"
#include "terrain/generalize/generalize_rows.h"

namespace belvedere {

// Ground metres per output pixel, which vary slowly: sampled every few cells of the DEM, linear
// between.
struct PixelGround {
  Grid<float> m_per_pixel;  // cell (i, j) is the DEM's (step_cells i, step_cells j); constant
                            // beyond. Empty: every band prints
  int step_cells = 1;       // ≥ 1
};

// How one band finds its break lines.
struct BreakLines {
  BreakLineScale scale;  // at the band's cells
  double blur_cells = 1.0;
  float exponent = 1.F;  // 0: c is 1 everywhere
};

// A band of the pyramid: G_i, G_i+1 and the change D_i+1 = G_i+1' - G_i+1 by the bands below
// (empty: none), and the spatially varying inputs at this level; null if constant.
struct Band {
  const Grid<float>* level = nullptr;
  const Grid<float>* coarser = nullptr;
  const Grid<float>* coarser_change = nullptr;
  const Grid<float>* share = nullptr;
  const Grid<unsigned char>* keep = nullptr;
  const Grid<float>* mask = nullptr;
  const Grid<float>* amplify = nullptr;
  const PixelGround* pixel_ground = nullptr;
  int level_cells = 1;  // of the DEM in a cell of this level
};

// D_i = expand(D_i+1) + (w - 1) L_i, row by row in strips, without other grids. Empty if nothing
// changes. The partial sum whose curvature is c is expand(G_i+1 + D_i+1).
Grid<float> add_band(const Band& band, const BandWeights& weights, const BreakLines& break_lines);

// Equal to expand(change), 0 if there is none.
void expand_change_row(const Grid<float>& change, int y, int width, float* out);

}  // namespace belvedere
