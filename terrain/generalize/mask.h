#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/progress.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Masks of equation 6: 1 where terrain is generalized, 0 where it stays as it is. generalize() takes them to coarser bands itself.

struct SlopeRange {
  double original_to_deg = 3.0;        // up to this slope 0
  double generalized_from_deg = 10.0;  // from this slope 1, smoothstep between; above original_to_deg, below 90
};
// By the slope (Horn) of the ground smoothed by one cell, so that single rough cells of a plain count for nothing. What is flat for more
// than three cells keeps five cells around it too, fading over some more: where a slope begins to rise the ground bends up, and there
// amplified middle bands would dig.
Grid<float> slope_mask(const Grid<float>& altitude_m, glm::dvec2 cell_m, const SlopeRange& range);

// How much of the generalization each class takes, 0…1: 0 for lakes and valley floors, 1 for what the map maker does not name.
using GeneralizedShares = std::array<float, land_cover_class_count>;
Grid<float> class_mask(const Grid<LandCoverClass>& classes, const GeneralizedShares& shares);

// For GeneralizeGrids::amplification_mask, where it lets flats be smoothed all the same. Where flat ground meets steep slopes, and nowhere
// else: there amplified middle bands would dig a moat along the foot of the slope. Flat is less than 3° (all) to 12° (nothing) after a blur
// of 1.5 cells, with six cells around it; it counts as far as reach_cells beside slopes of more than 12° to 20°. reach_cells: about the
// largest landform amplified, 2^bands cells; 2…256.
Grid<float> slope_foot_mask(const Grid<float>& altitude_m, glm::dvec2 cell_m, int reach_cells);

// A mask drawn by a cartographer, reprojected into `frame`: 0 or black is original, the largest value it can hold (1, or 255 where values
// above 1 occur) generalized. Where the file has no data, terrain is generalized. Throws Error(input) as warp_rasters does,
// and for values outside 0…255 or a file without data in the frame.
Grid<float> read_mask(const RasterSource& source, const RasterFrame& frame, Progress& progress);

// The mask as the second level of its Gaussian pyramid shows it, with edges about eight cells wide. The finest band meets the mask itself:
// along a hard edge, as drawn masks and classes have it, that band would begin with a step.
Grid<float> soften_mask(const Grid<float>& mask);

// Cell by cell the product, so that each mask protects what it protects alone. An empty grid is 1 everywhere.
Grid<float> combine_masks(Grid<float> a, const Grid<float>& b);

}  // namespace belvedere
