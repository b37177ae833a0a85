#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/base/grid.h"

namespace belvedere {

// One thing that steers synthesis, quantized to 0…255 so that all costs are integers. The same quantization holds for
// exemplar and target: whoever makes the pair decides it (renderer/paint).
struct Guide {
  std::string name;            // "altitude", "tone", "distance", "shadow", "slope", "fall_line_x" …
  Grid<std::uint8_t> values;
};

// All guides of one picture. `label` (land-cover class or any id < 255) is a hard filter; 255 marks what must not be used.
struct GuideStack {
  Grid<std::uint8_t> label;
  std::vector<Guide> guides;
  Grid<float> depth_m;         // for silhouettes: neighbours across a jump are no neighbours; empty where there are none

  int width() const { return label.width(); }
  int height() const { return label.height(); }
};

}  // namespace belvedere
