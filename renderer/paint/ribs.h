#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "renderer/trace/camera.h"

namespace belvedere {

// Ribs and gullies down the fall linethat model rock: image noise, smeared along the fall line
// (line integral convolution, Cabral & Leedom 1993), taken as a relief and lit from one side.
struct RibParameters {
  double pixels_per_unit = 1.0;  // a unit is 0.5 mm of the sheet
  double sun_side = 1.0;         // > 0: flanks that face right are lit, < 0: those that face left
  std::uint64_t seed = 1;
  Grid<float> sides =
      {};  // sun_side of each pixel, -1…1, where light varies with position; else empty
};

// Ribs have three widths: deviation of the noise, and the length of integration along the fall
// line.
struct RibWidth {
  double sigma_units;
  double length_units;
  float strength;
};
inline constexpr std::array<RibWidth, 3> rib_widths = {
    {{3.2, 44.0, 0.50F}, {1.6, 22.0, 0.30F}, {7.0, 80.0, 0.55F}}};

// Noise of each width, integrated down the fall line through each pixel; mean 0, deviation 1 where
// the fall line is straight (the sum of correlated samples is normalized analytically). A
// streamline that reaches another surface, or ground without a fall line, continues straight, so
// nothing crosses a silhouette. Its path beyond the pixel is read from the wide view. Pixels far
// from any that is `marked` hold 0.
std::array<Grid<float>, 3> integrate_along_fall_line(const GuidanceBuffers& guidance,
                                                     const WideView& wide,
                                                     const Grid<std::uint8_t>& marked,
                                                     std::uint64_t seed, glm::ivec2 origin_px,
                                                     double pixels_per_unit);

// The light on the ribs: about -1 … 1, mean 0. Only valid where pixels are `marked`. Reach:
// rib_near_margin_px() in the pixels, rib_margin_px() in the wide view.
Grid<float> make_ribs(const GuidanceBuffers& guidance, const WideView& wide,
                      const Grid<std::uint8_t>& marked, const RibParameters& parameters,
                      glm::ivec2 origin_px);
int rib_near_margin_px(double pixels_per_unit);
int rib_margin_px(double pixels_per_unit);

}  // namespace belvedere
