#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// A painting with its labels; valid during a call.
struct LabelledPicture {
  const Grid<glm::vec3>* picture;    // encoded sRGB
  const Grid<std::uint8_t>* labels;  // unused_label is ignored and not changed
};

// Harmonizes the colours of several paintings that are used for one picture: for each label found
// in two or more, each gets their common mean and spread (covariance) in OKLab, with equal weight
// for every texel, or those of `reference`, by the linear map that changes colours least (Pitié &
// Kokaram 2007). Spreads change at most threefold. A label found in one painting only gets the mean
// shift of that painting's other labels. Across borders of labels the maps blend over a few texels,
// so that masks leave no outline. Results are clamped to 0…1. Error(usage) where sizes disagree or
// there is no such reference.
std::vector<Grid<glm::vec3>> harmonize(const std::vector<LabelledPicture>& pictures,
                                       std::optional<std::size_t> reference);

// Harmonizes by the scene's setting: "off", "common" (common statistics), "first" (those of the
// first painting), by label; or "regions": all but the first are matched to the first by regions of
// similar colour, whatever their labels (texture/statistical/photometric.h). Error(usage) for other
// words.
std::vector<Grid<glm::vec3>> harmonize_as(const std::string& how,
                                          const std::vector<LabelledPicture>& pictures);

// Difference between the colours of one label in two paintings: earth mover's distance of the
// histograms in OKLab, mean of the three axes. 0 where one of them lacks the label.
double colour_distance(const LabelledPicture& a, const LabelledPicture& b, std::uint8_t label);

}  // namespace belvedere
