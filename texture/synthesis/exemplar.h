#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
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

// 8-bit encoded sRGB, in which patches are compared. Only replay reads the painting at full depth.
using Rgb8 = std::array<std::uint8_t, 3>;
// An encoded colour, 0…1, to the nearest of 256 steps.
Rgb8 to_rgb8(glm::vec3 encoded);

// A picture with its guides, ready for copying.
struct Exemplar {
  static constexpr int largest_side = 32767;  // texels

  std::string name;
  Grid<Rgb8> picture;
  GuideStack guides;  // label 255: never a source (lettering, frames, excluded areas); depth:
                      // no piece is copied across its jumps
};

// Throws Error(usage) if picture and guides differ in size or are empty, Error(limit) over the
// largest side.
void check_exemplar(const Exemplar& exemplar);

}  // namespace belvedere
