#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/layers/fit/fit_measures.h"

namespace belvedere {

struct HueSaturation {
  double hue_deg = 0.0;     // 0…360; 0 where it has none
  double saturation = 0.0;  // 0…1, (max - min) / max
  double value = 0.0;       // 0…1, max / 255
  bool grey = false;        // channels differ by no more than `grey_range`: its hue is an accident
};
// Smith 1978. Channels 0…255.
HueSaturation hue_saturation_of(const glm::dvec3& rgb, double grey_range = 12.0);

// A colour's place in the hue–saturation plane: saturation in the direction of its hue; greys are drawn in to three tenths, since their hue
// is noise. Multiplying all channels by one number moves nothing but where the grey range is crossed.
struct PlanePlace {
  double x = 0.0;
  double y = 0.0;
};
PlanePlace hue_saturation_place(const HueSaturation& colour);

// Blurs colour and keeps lightness: JPEG stores chroma in blocks at half size, and without this classes come out square.
Grid<glm::vec3> smooth_chroma(const Grid<glm::vec3>& picture, double sigma_cells = 2.5);

}  // namespace belvedere
