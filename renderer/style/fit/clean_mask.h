#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// Numbers of a mask beside those of classes. unused_label (255) counts nowhere.
inline constexpr std::uint8_t far_air_label = 200;  // ranges so far that they show the air's colour

struct CleanMaskParameters {
  double blur_px = 2.0;          // paint is looked at without its strokes
  std::size_t min_texels = 600;  // a class of no more is left out
  int groups = 5;                // of colours, that a class is split into
  double different = 0.10;       // OKLab with hue × 1.6: medians of classes that are no likes
  double nearer = 0.5;           // of the distance to its own class's median
  double min_kept = 0.3;         // a class that would lose more is taken as it was drawn
};

// A rough mask, made safe (recipe A0): groups of colours within a class that look like another,
// clearly different class more than like their own are left out (unused_label). Sky and far air
// stay as they are. `colours` is OKLab.
Grid<std::uint8_t> clean_mask(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& drawn,
                              const CleanMaskParameters& parameters = {});

// The three channels by blur_within_labels (base/masks/label_blur.h).
Grid<glm::vec3> blur_within_classes(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                                    double sigma_px);

}  // namespace belvedere
