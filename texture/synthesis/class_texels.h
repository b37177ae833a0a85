#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Pixels that a texel may serve before repetition is to be expected: the same number at which
// synthesis begins to relax guides (synth_lists.h). Measured on one painting with a decreasing
// number of allowed texels (docs/synthesis.md): up to 4 pixels per texel the statistics of strokes
// stay close to the painting's, from 8 on they deviate.
inline constexpr std::size_t pixels_per_texel = 4;

// Available texels of a class in the exemplars, and the pixels of a target that need them.
struct ClassTexels {
  std::uint8_t label = 0;
  std::size_t texels = 0;  // of all exemplars
  std::size_t pixels = 0;  // of the target, including those of classes that fall back to this one
  std::size_t serves() const { return texels * pixels_per_texel; }
  bool enough() const { return pixels <= serves(); }
  std::size_t texels_needed() const { return (pixels + pixels_per_texel - 1) / pixels_per_texel; }
};

// The label each pixel copies from: its own, or its fallback if no exemplar has it; unused_label if
// neither has texels.
Grid<std::uint8_t> serving_labels(const std::vector<Exemplar>& exemplars,
                                  const Grid<std::uint8_t>& target,
                                  const std::map<std::uint8_t, std::uint8_t>& fallback);

// The classes that the target copies from, by label.
std::vector<ClassTexels> class_texels(const std::vector<Exemplar>& exemplars,
                                      const Grid<std::uint8_t>& target,
                                      const std::map<std::uint8_t, std::uint8_t>& fallback);

// One sentence that names the classes with too few texels, and the number needed; empty if all have
// enough. name: displayed name of a label.
std::string describe_scarcity(const std::vector<ClassTexels>& available,
                              const std::function<std::string(std::uint8_t)>& name);

}  // namespace belvedere
