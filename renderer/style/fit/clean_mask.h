#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// Value of a mask besides class ids. Pixels of unused_label (255) are ignored.
inline constexpr std::uint8_t far_air_label = 200;  // distant ranges in haze colour

struct CleanMaskParameters {
  double blur_px = 2.0;          // sigma of the blur that removes strokes
  std::size_t min_texels = 600;  // classes with no more are ignored
  int groups = 5;                // clusters of colour in a class
  double different = 0.10;       // of medians of different classes, OKLab with hue × 1.6
  double nearer = 0.5;           // max share of the distance to the own class's median
  double min_kept = 0.3;         // a class that would keep less is used as drawn
};

// Cleans a rough mask (recipe A0): clusters of colour within a class that resemble another, clearly
// different class more than their own become unused_label. Sky and distant haze are kept. `colours`
// is OKLab.
Grid<std::uint8_t> clean_mask(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& drawn,
                              const CleanMaskParameters& parameters = {});

// blur_within_labels (base/masks/label_blur.h) of the three channels.
Grid<glm::vec3> blur_within_classes(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                                    double sigma_px);

}  // namespace belvedere
