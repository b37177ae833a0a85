#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "renderer/paint/palette.h"

namespace belvedere {

// The colours of each label in a painting by tone and distance: the source of its base picture if
// none was painted.
struct LabelRamps {
  std::vector<double> distances;  // ascending, in steps of the distance guide (0…255); one where
                                  // distance is unknown
  std::vector<ToneRamp> ramps;    // encoded sRGB, one for each distance, interpolated between them,
                                  // beyond them constant
  std::size_t texels = 0;
  // The colour at a tone, 0…1, and a distance.
  glm::vec3 colour(double tone, double distance) const;
};
using FittedRamps = std::array<LabelRamps, 256>;  // by label; no ramps if the painting has fewer
                                                  // texels than min_texels

inline constexpr std::size_t min_texels = 32;

// Smooth ramps through the median colours (encoded sRGB) of label × tone × distance. `distance` as
// the guide of that name, or empty. Texels of unused_label are ignored.
FittedRamps fit_ramps(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                      const Grid<float>& tone, const Grid<std::uint8_t>& distance);

// The picture of these ramps, without strokes. Texels without a ramp keep their colour in
// `picture`.
Grid<glm::vec3> make_ramp_base(const FittedRamps& ramps, const Grid<glm::vec3>& picture,
                               const Grid<std::uint8_t>& labels, const Grid<float>& tone,
                               const Grid<std::uint8_t>& distance);
// The same, moved by class to the mean of the paint: strokes that are not symmetrical, dark
// outlines or light flecks, would otherwise darken or lighten whatever is copied.
Grid<glm::vec3> make_centred_base(const FittedRamps& ramps, const Grid<glm::vec3>& picture,
                                  const Grid<std::uint8_t>& labels, const Grid<float>& tone,
                                  const Grid<std::uint8_t>& distance);

}  // namespace belvedere
