#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "texture/statistical/band_pyramid.h"

namespace belvedere {

struct PhotometricParameters {
  int regions = 3;       // of similar colour in each picture, matched between the two; 1…5
  double blur_px = 3.0;  // sigma of the blur before regions are separated
  double largest_value_gain =
      2.0;  // max factor of a map on differences of brightness, so that grain is not amplified
  double grey_saturation = 0.1;  // below this, hue is noise and only shifts with its region
  std::array<double, 2> grey_fade = {
      0.8, 1.2};  // from the first to the second multiple of it the hue's own map fades in
  std::array<double, 2> pull_fade = {0.1,
                                     0.3};  // turns of a hue over which its colour fades to grey
};

// The source with the colours of the target: both are split into regions of similar colour, which
// are matched by their position among their picture's colours; for each pair, the distributions of
// hue, saturation and value (HSV) are mapped from one to the other by 33 quantiles, and a pixel
// gets the maps of all regions weighted by its membership, with hues as directions. After Zalesny
// et al. (2005); the limits are ours: no map of hue is steeper than 1, greys only shift with their
// region, and a hue foreign to the region, such as the blue of gaps between leaves, becomes grey
// instead of a bright fleck of the partner's. Encoded sRGB, 0…1. `..._counts` empty or of its
// picture's size: 0 excludes a pixel from the statistics. Error(input) where nothing counts,
// Error(usage) for other numbers of regions. The result does not depend on the number of threads.
Grid<glm::vec3> correct_colours(const Grid<glm::vec3>& source, const Grid<glm::vec3>& target,
                                const PhotometricParameters& parameters = {},
                                const Grid<std::uint8_t>& source_counts = {},
                                const Grid<std::uint8_t>& target_counts = {});

// The part of a picture that resembles a crop: the `share` of its pixels (of those that count, as
// above) whose blurred colour is nearest to the crop's mean; 1: belongs to it. Colours are compared
// per lightness, because that changes with the light of the day. Error(input) where nothing counts.
Grid<std::uint8_t> find_similar_colours(const Grid<glm::vec3>& picture, const Grid<glm::vec3>& crop,
                                        double share, const Grid<std::uint8_t>& picture_counts = {},
                                        const Grid<std::uint8_t>& crop_counts = {});

// Dissimilarity of the histograms of two pictures, L1 of 32 bins each, 0…2: hue (weighted by
// saturation), saturation, value.
std::array<double, 3> colour_histogram_distance(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b);

// Light and shade of a crop come from relief and are not texture (Zalesny et al. 2005 call such
// crops composite): each half is learnt separately.
enum class LightHalf { lit, shaded };

// The states of a crop's pixels without those of the other half: pixels lighter, or darker, than
// the median of its lightness blurred over `blur_px` (sigma), which removes strokes and keeps the
// illumination. `states` (empty: all) selects the crop's pixels; others are ignored.
Grid<std::uint8_t> light_half(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states,
                              LightHalf half, double blur_px = 6.0);

}  // namespace belvedere
