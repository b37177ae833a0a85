#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "renderer/paint/palette.h"

namespace belvedere {

// The colours a painting gives to each label by tone and distance: what its base picture is made of where nobody painted one.
struct LabelRamps {
  std::vector<double> distances;  // rising, in steps of the distance guide (0…255); one where distance is not known
  std::vector<ToneRamp> ramps;    // encoded sRGB, one for each distance, between them interpolated, beyond them constant
  std::size_t texels = 0;
  // tone 0…1.
  glm::vec3 colour(double tone, double distance) const;
};
using FittedRamps = std::array<LabelRamps, 256>;  // by label; no ramps where the painting has fewer texels than least_texels

inline constexpr std::size_t least_texels = 32;

// Smooth ramps through the median colours (encoded sRGB) of label × tone × distance. `distance` as the guide of that name, or empty.
// Texels of unused_label count nowhere.
FittedRamps fit_ramps(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels, const Grid<float>& tone,
                      const Grid<std::uint8_t>& distance);

// The strokeless picture of these ramps. Texels without a ramp keep the colour they have in `picture`.
Grid<glm::vec3> make_ramp_base(const FittedRamps& ramps, const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                               const Grid<float>& tone, const Grid<std::uint8_t>& distance);

}  // namespace belvedere
