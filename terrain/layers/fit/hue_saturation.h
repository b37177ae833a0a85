#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/layers/fit/fit_measures.h"

namespace belvedere {

struct HueSaturation {
  double hue_deg = 0.0;     // 0…360; 0 if it has none
  double saturation = 0.0;  // 0…1, (max - min) / max
  double value = 0.0;       // 0…1, max / 255
  bool grey = false;        // channels differ by at most `grey_range`: the hue is meaningless
};
// Smith 1978. Channels 0…255.
HueSaturation hue_saturation_of(const glm::dvec3& rgb, double grey_range = 12.0);

// A colour's position in the hue–saturation plane: saturation as radius and hue as angle. Greys are
// drawn in to three tenths, since their hue is noise. A common factor on all channels does not
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
