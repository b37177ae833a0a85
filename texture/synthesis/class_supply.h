#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {

// So many pixels a texel may serve before repetition is to be expected: as many as synthesis asks of a texel before it lets guides go
// astray for others (synth_lists.h). Measured on one painting with ever fewer of its texels allowed (docs/synthesis.md): up to 4 pixels a
// texel the statistics of strokes stay near the painting's, from 8 on they leave it.
inline constexpr std::size_t pixels_per_texel = 4;

// What a class of the exemplars has to give, and what a target asks of it.
struct ClassSupply {
  std::uint8_t label = 0;
  std::size_t texels = 0;  // of all exemplars
  std::size_t pixels = 0;  // of the target, those of classes that fall back to this one included
  std::size_t serves() const { return texels * pixels_per_texel; }
  bool enough() const { return pixels <= serves(); }
  std::size_t texels_needed() const { return (pixels + pixels_per_texel - 1) / pixels_per_texel; }
};

// The label each pixel copies from: its own, or its fallback where no exemplar has it; unused_label where neither has texels.
Grid<std::uint8_t> serving_labels(const std::vector<Exemplar>& exemplars, const Grid<std::uint8_t>& target,
                                  const std::map<std::uint8_t, std::uint8_t>& fallback);

// The classes that the target copies from, by label.
std::vector<ClassSupply> class_supply(const std::vector<Exemplar>& exemplars, const Grid<std::uint8_t>& target,
                                      const std::map<std::uint8_t, std::uint8_t>& fallback);

// One sentence that names the classes which are asked for more than they have, and how many texels would be needed; empty where all
// have enough. name: how people call a label.
std::string describe_scarcity(const std::vector<ClassSupply>& supply, const std::function<std::string(std::uint8_t)>& name);

}  // namespace belvedere
