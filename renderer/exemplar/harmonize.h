#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// A painting with its labels, for the time of a call.
struct LabelledPicture {
  const Grid<glm::vec3>* picture;    // encoded sRGB
  const Grid<std::uint8_t>* labels;  // unused_label counts nowhere and is not changed
};

// Brings the colours of several paintings together before they serve one picture: of each label that two or more have, each gets the
// mean and the spread (covariance) in OKLab that they have in common, every texel counting the same, or those of `reference`, by the linear
// map that moves colours least (Pitié & Kokaram 2007). Spreads change at most threefold. A label that one painting has alone goes along
// with the mean shift of that painting's others. Across borders of labels the maps blend over a few texels, so that masks leave no outline.
// Results are cut to 0…1. Error(usage) where sizes disagree or there is no such reference.
std::vector<Grid<glm::vec3>> harmonize(const std::vector<LabelledPicture>& pictures, std::optional<std::size_t> reference);

// The same as a scene says it: "off", "common" (what they have in common), "first" (like the first painting), by label; or "regions": all
// but the first are corrected by regions of like colour, whatever their labels, to the first one's (texture/statistical/photometric.h).
// Error(usage) for other words.
std::vector<Grid<glm::vec3>> harmonize_as(const std::string& how, const std::vector<LabelledPicture>& pictures);

// How unlike the colours of one label are in two paintings: earth mover's distance of the histograms in OKLab, mean of the three axes.
// 0 where one of them lacks the label.
double colour_distance(const LabelledPicture& a, const LabelledPicture& b, std::uint8_t label);

}  // namespace belvedere
