#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

struct PhotometricParameters {
  int regions = 3;                               // of like colour in each picture, paired between the two; 1…5
  double blur_px = 3.0;                          // sigma of the blur in which regions are told apart
  double largest_value_gain = 2.0;               // how much a map may spread brightness, so that grain is not blown up
  double grey_saturation = 0.1;                  // below it hue is noise and only shifts with its region
  std::array<double, 2> grey_fade = {0.8, 1.2};  // over these multiples of it the hue's own map sets in
  std::array<double, 2> pull_fade = {0.1, 0.3};  // turns that a hue is pulled by, over which its colour fades to grey
};

// The source with the colours of the target: both fall into regions of like colour, which are paired by where they stand among their
// picture's colours; of each pair, the distributions of hue, saturation and value (HSV) of the one are mapped to the other's by 33
// quantiles, and a pixel takes the maps of all regions by how much it is of each, hues as directions. After Zalesny et al. (2005);
// the limits are ours: no map of hue is steeper than 1, greys only turn with their region, and a hue that is not the region's, such as
// the blue of gaps between leaves, becomes grey instead of a bright fleck of the partner's.
// Encoded sRGB, 0…1. `..._counts` empty or of its picture's size: 0 leaves a pixel out of what is measured. Error(input) where nothing
// counts, Error(usage) for other numbers of regions. Every thread count makes the same bits.
Grid<glm::vec3> correct_colours(const Grid<glm::vec3>& source, const Grid<glm::vec3>& target, const PhotometricParameters& parameters = {},
                                const Grid<std::uint8_t>& source_counts = {}, const Grid<std::uint8_t>& target_counts = {});

// How unlike the histograms of two pictures are, L1 of 32 bins each, 0…2: hue (weighted by saturation), saturation, value.
std::array<double, 3> colour_histogram_distance(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b);

// Hue in turns, 0…1; saturation and value 0…1.
glm::dvec3 to_hsv(glm::dvec3 rgb);
glm::dvec3 from_hsv(glm::dvec3 hsv);

}  // namespace belvedere
