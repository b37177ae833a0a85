#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/generalize/generalize_band.h"

namespace belvedere {

// Form of plan curvature for break lines. N and g are in generalize_rows.h; both forms are
// multiplied by the cell size of the band, so that ridges of the same shape count equally in every
// band.
enum class CurvatureForm {
  bounded,  // N/g², the change of slope across the contour: small in flats, largest on steep ridges
  plan,     // N/g³, 1 / radius of the contour: also finds gentle ridges, and is noisy in flats
};

// Weights of the Laplacian bands, lowest (coarsest) band first as in figure 2 of Jenny, Jenny &
// Hurni 2011. Bands are relative to the cells of the DEM: with b1 the finest, b_i holds features of
// 2^(i-1) to 2^i cells, on a 30 m DEM 30–60 m for b1 and 1–2 km for b6. For other cell sizes
// weights must be shifted by the logarithm of the ratio.
struct GeneralizeParameters {
  std::vector<float> foreground = {1.F, 1.F, 1.F,
                                   1.F, 1.F, 1.F};  // u, 0…5; their number is the number of bands
  std::vector<float> background = {1.F, 1.F, 1.F, 1.F, 1.F, 1.F};  // as many as foreground
  // Sharpening of high crests: adds crest · high · clamp(b2 + b3 + .6 b4, 0, 60 m) · (1 - .2 (1 -
  // foreground share)), high = clamp((b5 + b6 + base - 1200 m) / 700 m, 0, 1), bands unweighted. 0
  // is off; 0…3.
  float crest = 0.F;
  // Weight of G_1, what remains below the lowest band, in equation 2: one for near and far. It
  // scales altitudes about 0 m. 0…5; 1 is the identity.
  float base = 1.F;

  // v of equation 4, -5…5, added to u in proportion to c, the strength of the break line. The sign
  // of the band's detail selects the set: convex (ridges) or concave (valleys). As many as
  // foreground, or empty for none.
  std::vector<float> foreground_ridges = {};
  std::vector<float> foreground_valleys = {};
  std::vector<float> background_ridges = {};
  std::vector<float> background_valleys = {};

  CurvatureForm curvature = CurvatureForm::bounded;
  // Curvature times cell of a full break line, c = 1. 0: the default of the form, .15 bounded and
  // .8 plan, which one position in twenty reaches in alpine terrain of any cell size; else .001…10.
  float full_curvature = 0.F;
  float blur_cells =
      1.F;  // standard deviation of the blur of c, in cells of its band; 0…10, 0 is none
  float exponent = 1.F;  // of c, 0…4: 0 treats slopes like ridges (w = u + v), 1 only break lines

  // Number of halvings (base/pyramid.h) between the DEM for which the weights are meant and this
  // one: that many of the finest weights are skipped, and the others act as they would in the finer
  // DEM. 0…16.
  int finest_band = 0;

  // The shortest printable landform in output pixels: with GeneralizeGrids::pixel_ground, bands
  // whose wavelength (four of their cells) is shorter fade out, and are 0 at half of it. 0.5…20.
  float print_pixels = 2.5F;
};

// Spatially varying inputs. Each grid is empty or of the DEM's size.
struct GeneralizeGrids {
  Grid<float> foreground_share;  // u_d of equation 5: 1 near, 0 far; empty: 1 everywhere
  Grid<unsigned char> keep;      // != 0 keeps its altitude exactly (lakes)
  Grid<float> mask;              // m of equation 6: 1 generalized, 0 original; empty: 1 everywhere
  // For a halved DEM: != 0 where the mask was 0 in a cell of the data; empty: as in the mask.
  Grid<unsigned char> unchanged = {};
  // 1 where bands may be exaggerated, 0 where weights are limited to 1: prevents moats and still
  // lets flats be smoothed; empty: 1 everywhere.
  Grid<float> amplification_mask;
  PixelGround pixel_ground;
  // For a halved DEM: the residue in its cells of each band finer than they are, the finest first
  // (finer_bands); empty: none.
  std::vector<Grid<float>> finer_m = {};
};

// The residue in a DEM, halved so many times, of the bands finer than its cells, the finest first:
// the mean of a band over a cell, which is not quite 0 because the kernel of the pyramid is not
// ideal.
std::vector<Grid<float>> finer_bands(const Grid<float>& altitude_m, int halvings);

// Equations 1 to 6: A' = ((base - 1) m_xy1 + 1) G_1 + Σ w_xyi L_i with w_xyi = (u_i + v_i c_xyi -
// 1) m_xyi + 1, u_i and v_i mixed by the foreground share, and u_i + v_i c_xyi times the printable
// share of the band.
// c_xyi is the plan curvature of the sum of the bands below, already weighted, at the band's size:
// |curvature| · cell / full_curvature, at most 1, then blurred, then raised to the exponent. All
// grids reach the coarser bands through the Gaussian pyramid. cell_m: width and height of a cell on
// the ground.
// Cells of `keep`, and those in which the mask is 0, keep their altitude exactly. To avoid a step
// at their shore or a plateau above a lowered valley, each band's weight returns to 1 towards them
// as by a mask, the remaining change of the lake is also subtracted from the land around it, fading
// over 32 cells, and the rest fades over the last six cells, 16 beside a mask's zeros.
// Needs 7 bytes per cell besides the DEM and these grids, 4 of them for the result. A DEM too small
// for all bands omits the coarsest. If all weights are 1 or the mask is 0 the input is returned bit
// for bit. Throws Error(usage) if sets of weights differ in number, Error(bug) if grids differ in
// size.
Grid<float> generalize(const Grid<float>& altitude_m, glm::dvec2 cell_m,
                       const GeneralizeGrids& grids, const GeneralizeParameters& parameters,
                       Progress& progress);

}  // namespace belvedere
