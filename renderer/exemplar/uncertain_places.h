#pragma once

#include <cstdint>

#include "base/grid.h"
#include "renderer/paint/composite.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Guides of a painting whose places are not exactly known: each texel gets what its place says on
// average, over the places that it may have.

// By how many pixels the place of a texel may be off in one direction, standard deviation, from a
// trust of 0…1: 0 at 1, a hundredth of the picture's width at .5, more than the picture at 0.
Grid<float> place_deviation(const Grid<float>& trust);
// The trust of such a deviation, of a picture of that width.
float place_trust(double deviation_px, int width);

// Values averaged within the labels over as many pixels (Gaussian; in steps of factor 2 from half a
// pixel on).
Grid<float> average_over_places(const Grid<float>& values, const Grid<std::uint8_t>& labels,
                                const Grid<float>& deviation_px);
// All guides of a stack but tone and shadow.
void average_over_places(const Grid<float>& deviation_px, GuideStack& guides);

// unused_label where the places that a texel may have show other labels in more than half of the
// cases.
Grid<std::uint8_t> certain_labels(const Grid<std::uint8_t>& labels,
                                  const Grid<float>& deviation_px);

// unused_label where sky (label 0) may be ground, because the skyline may be that many pixels too
// low.
Grid<std::uint8_t> certain_sky(Grid<std::uint8_t> labels, int skyline_px);

// What synthesis compares: the part of a painting that the residual carries over, picture -
// residual · base, because a seam shows where that part jumps and not where light does. Each label
// is stretched to the same contrast about mid grey: otherwise low-contrast strokes would be torn
// apart to satisfy guides.
Grid<Rgb8> seam_picture(const PaintedExemplar& painted, const Grid<std::uint8_t>& labels,
                        double residual);

}  // namespace belvedere
