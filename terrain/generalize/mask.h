#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/progress.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Masks of equation 6: 1 where terrain is generalized, 0 where it is unchanged. generalize()
// reduces them to coarser bands.

struct SlopeRange {
  double original_to_deg = 3.0;  // up to this slope 0
  double generalized_from_deg =
      10.0;  // from this slope 1, smoothstep between; above original_to_deg, below 90
};
// Mask by the slope (Horn) of the ground smoothed by one cell, so that single rough cells of a
// plain are ignored. A flat of more than three cells includes five cells around it, fading over
// some more: where a slope starts the ground is concave, and amplified medium bands would dig
// there.
Grid<float> slope_mask(const Grid<float>& altitude_m, glm::dvec2 cell_m, const SlopeRange& range);

// Mask value of each class, 0…1: 0 for lakes and valley floors, 1 for classes that are not listed.
using GeneralizedShares = std::array<float, land_cover_class_count>;
Grid<float> class_mask(const Grid<LandCoverClass>& classes, const GeneralizedShares& shares);

// For GeneralizeGrids::amplification_mask, which still lets flats be smoothed. Only where flat
// ground meets steep slopes: there amplified medium bands would dig a moat along the foot of the
// slope. Ground counts as flat from 3° (fully) to 12° (not) after a blur of 1.5 cells, with six
// cells around it, and matters up to reach_cells from slopes of more than 12° to 20°. reach_cells:
// about the largest amplified landform, 2^bands cells; 2…256.
Grid<float> slope_foot_mask(const Grid<float>& altitude_m, glm::dvec2 cell_m, int reach_cells);

// A mask drawn by a cartographer, reprojected into `frame`: 0 or black is original, the largest
// possible value (1, or 255 if values above 1 occur) is generalized. Where the file has no data,
// terrain is generalized. Throws Error(input) as warp_rasters does, for values outside 0…255, and
// for a file without data in the frame.
Grid<float> read_mask(const RasterSource& source, const RasterFrame& frame, Progress& progress);

// The mask at the second level of its Gaussian pyramid, with edges about eight cells wide. The
// finest band uses the mask itself, and a hard edge, as in drawn masks and classes, would put a
// step into it. Cells of 0 stay 0: next to them it fades over six cells.
Grid<float> soften_mask(const Grid<float>& mask);

// Product of two masks, so that each protects its own area. An empty grid is 1 everywhere.
Grid<float> combine_masks(Grid<float> a, const Grid<float>& b);

// Blends an operator's result by a mask: `after` where the mask is 1 or empty, `before` bit for bit
// where it is 0, linear in between.
Grid<float> apply_mask(const Grid<float>& before, Grid<float> after, const Grid<float>& mask);

// 1 in cells that may not change: those of `keep` != 0, and those in which the mask is 0. Either
// may be empty; both: empty.
Grid<std::uint8_t> unchanged_cells(const Grid<std::uint8_t>& keep, const Grid<float>& mask);

// u_d of equation 5 as a function of the distance from the viewer: exactly 1 up to foreground_to,
// 1/2 halfway, exactly 0 from background_from on. Between the two it falls along a line whose kinks
// are rounded by parabolas over an eighth of the span inside each end. It is therefore 8/7 as steep
// as a line from end to end, the least for a function without kinks that keeps both ends and turns
// within an eighth. Any unit; background_from must exceed foreground_to.
double foreground_share(double distance, double foreground_to, double background_from);

}  // namespace belvedere
