#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/generalize/pixel_ground.h"

namespace belvedere {

// Which plan curvature finds break lines. N and g are in generalize_rows.h; both are multiplied by the cell of the band at hand, so that a
// ridge of one shape counts the same in every band.
enum class CurvatureForm {
  bounded,  // N/g², the change of slope across the contour: small in flats, largest on steep ridges
  plan,     // N/g³, 1 / radius of the contour: finds gentle ridges as well, and restless in flats
};

// Weights of the Laplacian bands, lowest (coarsest) band first as in figure 2 of Jenny, Jenny & Hurni 2011. Bands go by the
// cells of the DEM at hand: with b1 the finest, b_i holds features of 2^(i-1) to 2^i cells, on a 30 m DEM 30–60 m for b1 and 1–2 km for
// b6. A DEM of other cells needs its weights moved by the logarithm of the cell sizes to look the same.
struct GeneralizeParameters {
  std::vector<float> foreground = {1.F, 1.F, 1.F, 1.F, 1.F, 1.F};  // u, 0…5; their number is the number of bands
  std::vector<float> background = {1.F, 1.F, 1.F, 1.F, 1.F, 1.F};  // as many as foreground
  // Sharpening of high crests: adds crest · high · clamp(b2 + b3 + .6 b4, 0, 60 m) · (1 - .2 (1 - foreground share)),
  // high = clamp((b5 + b6 + base - 1200 m) / 700 m, 0, 1), bands unweighted. 0 is off; 0…3.
  float crest = 0.F;

  // v of equation 4, -5…5, added to u in proportion to how much of a break line a place is. Which of the two sets counts is decided
  // by whether the band adds convex (ridges) or concave (valleys) detail there. As many as foreground, or empty for none.
  std::vector<float> foreground_ridges = {};
  std::vector<float> foreground_valleys = {};
  std::vector<float> background_ridges = {};
  std::vector<float> background_valleys = {};

  CurvatureForm curvature = CurvatureForm::bounded;
  // Curvature times cell that makes a full break line, c = 1. 0: the form's usual one, .15 bounded and .8 plan, which in alpine terrain
  // of any cell one place in twenty reaches; else .001…10.
  float full_curvature = 0.F;
  float blur_cells = 1.F;  // standard deviation of the blur of c, in cells of its band; 0…10, 0 is none
  float exponent = 1.F;    // of c, 0…4: 0 treats slopes like ridges (w = u + v), 1 only break lines

  // How many times the DEM at hand was halved (base/pyramid.h) from the one that the weights are meant for: so many of the finest weights
  // are left out, and what is left is what the finer DEM would have got in those bands. 0…16.
  int finest_band = 0;

  // The shortest landform that the print shows, in output pixels: with GeneralizeGrids::pixel_ground, bands whose wavelength
  // (four of their cells) is shorter fade, and are gone at half of it. 0.5…20.
  float print_pixels = 2.5F;
};

// What varies from place to place. Each grid is empty or of the DEM's size.
struct GeneralizeGrids {
  Grid<float> foreground_share;  // u_d of equation 5: 1 near, 0 far; empty: 1 everywhere
  Grid<unsigned char> keep;      // != 0 keeps its altitude exactly (lakes)
  Grid<float> mask;              // m of equation 6: 1 generalized, 0 original; empty: 1 everywhere
  // 1 where bands may be exaggerated, 0 where weights stop at 1: limits what digs moats and still lets flats be smoothed; empty: 1
  // everywhere.
  Grid<float> amplification_mask;
  PixelGround pixel_ground;
};

// Equations 1 to 6: A' = G_1 + Σ w_xyi L_i with w_xyi = (u_i + v_i c_xyi - 1) m_xyi + 1, u_i and v_i mixed by the foreground share,
// and u_i + v_i c_xyi times what of the band can be printed. c_xyi is the plan curvature of the sum of the bands below, already weighted,
// at the band's size: |curvature| · cell / full_curvature, at most 1, then blurred, then raised to the exponent. All grids reach
// the coarser bands through the Gaussian pyramid. cell_m: width and height of a cell on the ground.
// Cells of `keep` keep their altitude exactly. No step stands at their shore and none are left on a table above a lowered valley:
// each band's weight returns to 1 towards them as by a mask, the change still left in the lake is taken off the land around it,
// fading over 32 cells, and the rest off the last six.
// Above the DEM and these grids this takes 7 bytes a cell, of which 4 are the result.
// A DEM too small for all bands goes without the coarsest. Where all weights are 1 or the mask is 0 the input returns bit for bit.
// Throws Error(usage) where sets of weights differ in number, Error(bug) where grids differ in size.
Grid<float> generalize(const Grid<float>& altitude_m, glm::dvec2 cell_m, const GeneralizeGrids& grids,
                       const GeneralizeParameters& parameters, Progress& progress);

}  // namespace belvedere
