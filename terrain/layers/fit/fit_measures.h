#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/grid.h"
#include "terrain/layers/fit/fit_cells.h"

namespace belvedere {

// How well shares predict the classes of cells.
struct ClassMeasures {
  std::size_t cells = 0;  // compared
  double accuracy = 0.0;  // share of cells whose most likely class is the true one
  double mean_iou =
      0.0;  // mean over classes of the intersection over union of predicted and true cells
  double mean_auc = 0.0;    // over the classes that occur but do not cover everything
  std::vector<double> iou;  // [class]
  std::vector<double> auc;  // [class]; NaN if a class does not occur or nothing else does
  std::vector<std::vector<std::size_t>> counts;  // [true class][predicted class]
};
// Cells with label no_class are left out. Offsets as for most_likely.
ClassMeasures measure_classes(const ClassShares& shares, std::span<const std::uint8_t> labels,
                              std::span<const double> offsets = {});

// The probability that a cell of the class has a larger score than one of another class, ties
// counting half (area under the ROC curve; Mann and Whitney 1947). NaN if either kind is missing.
double area_under_curve(std::span<const float> scores, std::span<const std::uint8_t> is_class);

// Pictures are encoded sRGB of 0…255.

struct LabColour {
  double l = 0.0;
  double a = 0.0;
  double b = 0.0;
};
// CIE L*a*b* under D65 of a colour, which is clamped to 0…255.
LabColour lab_of_srgb(const glm::dvec3& rgb);
// Colour difference ΔE00 by CIEDE2000 (Sharma, Wu and Dalal 2005).
double colour_difference(const LabColour& one, const LabColour& other);

struct BlockDifference {
  int block = 1;           // cells along a side
  double mean = 0.0;       // ΔE00 of the mean colours of blocks
  double p95 = 0.0;        // exceeded by one block in twenty
  std::size_t blocks = 0;  // with at least .3 of their cells used
};
// Colour difference of two pictures over blocks of the used cells (use != 0; null: all).
BlockDifference block_difference(const Grid<glm::vec3>& picture, const Grid<glm::vec3>& other,
                                 const Grid<std::uint8_t>* use, int block);
// Mean squared difference in lightness of neighbouring used cells. The ratio of two pictures
// measures how much detail is kept.
double gradient_energy(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>* use);

struct HueSaturation {
  double hue_deg = 0.0;     // 0…360; 0 if it has none
  double saturation = 0.0;  // 0…1, (max - min) / max
  double value = 0.0;       // 0…1, max / 255
  bool grey = false;        // channels differ by at most `grey_range`: the hue is meaningless
  bool own_hue = false;     // a grey with a hue given to it
};
// Hue, saturation and value of a colour with channels 0…255.
HueSaturation hue_saturation_of(const glm::dvec3& rgb, double grey_range = 12.0);

// A colour's position in the hue–saturation plane: saturation as radius and hue as angle. Greys are
// drawn in to three tenths, since their hue is noise, or lie at the rim where they have a hue of
// their own. A common factor on all channels does not
// change it, except across the grey range.
struct PlanePosition {
  double x = 0.0;
  double y = 0.0;
};
PlanePosition hue_saturation_place(const HueSaturation& colour);

// Blurs chroma and keeps luma: JPEG stores chroma in blocks at half size, which would make classes
// blocky.
Grid<glm::vec3> smooth_chroma(const Grid<glm::vec3>& picture, double sigma_cells = 2.5);

}  // namespace belvedere
