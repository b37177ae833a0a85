#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// A label for no class: such texels are never copied, such pixels get no texel.
inline constexpr std::uint8_t unused_label = 255;

// A guide of synthesis, quantized to 0…255 so that all costs are integers. Exemplar and target use
// the same quantization, which is chosen where the pair is made (renderer/paint).
struct Guide {
  std::string name;  // "altitude", "tone", "distance", "shadow", "slope", "fall_line_x" …
  Grid<std::uint8_t> values;
};

// All guides of one picture. `label` (land-cover class or any id < 255) is a hard filter; 255 marks
// unusable pixels.
struct GuideStack {
  Grid<std::uint8_t> label;
  std::vector<Guide> guides;
  Grid<float> depth_m;  // for silhouettes: pixels across a jump do not count as neighbours; +inf is
                        // sky; empty: no silhouettes

  int width() const { return label.width(); }
  int height() const { return label.height(); }
  // The values of that guide, or null.
  const Grid<std::uint8_t>* find(const std::string& name) const {
    for (const Guide& guide : guides) {
      if (guide.name == name) return &guide.values;
    }
    return nullptr;
  }
};

// Throws Error(usage) if a grid of the stack differs in size from the labels, or a guide's name is
// empty or occurs twice. `where` names the stack in the message.
void check_guide_stack(const GuideStack& stack, const std::string& where);

}  // namespace belvedere
