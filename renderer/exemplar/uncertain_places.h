#pragma once

#include <cstdint>

#include "base/grid.h"
#include "renderer/paint/composite.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Guides of a painting whose places are not exactly known: each texel gets the mean over the places
// that it may have.

// Standard deviation of the place of a texel in one direction, px, from a trust of 0…1: 0 at 1, a
// hundredth of the picture's width at .5, more than the picture at 0.
Grid<float> place_deviation(const Grid<float>& trust);
// The trust of such a deviation in a picture of that width, px.
float place_trust(double deviation_px, int width);

// Averages values within the labels by a Gaussian of that deviation (in steps of factor 2 from half
// a pixel on).
Grid<float> average_over_places(const Grid<float>& values, const Grid<std::uint8_t>& labels,
                                const Grid<float>& deviation_px);
// Averages all guides of a stack except tone and shadow.
void average_over_places(const Grid<float>& deviation_px, GuideStack& guides);

// The labels, with unused_label where the places that a texel may have show other labels in more
// than half of the cases.
Grid<std::uint8_t> certain_labels(const Grid<std::uint8_t>& labels,
                                  const Grid<float>& deviation_px);

// The labels, with unused_label where sky (label 0) may be ground, because the skyline may be that
// many pixels too low.
Grid<std::uint8_t> certain_sky(Grid<std::uint8_t> labels, int skyline_px);

// The picture that synthesis compares: the part of a painting that the residual carries over,
// picture - residual · base, because a seam shows where that part jumps and not where light does.
// Each label is stretched to the same contrast about mid grey: otherwise low-contrast strokes would
// be torn apart to satisfy guides.
Grid<Rgb8> seam_picture(const PaintedExemplar& painted, const Grid<std::uint8_t>& labels,
                        double residual);

}  // namespace belvedere
