#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
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

struct SynthesisParameters {
  std::uint64_t seed = 1;
  int levels = 6;  // 1…8, fewer if the smallest side would be under 16
  std::vector<std::pair<std::string, double>>
      weights;  // by guide name; absent: 1; 0 switches a guide off; 0…100
  std::map<std::uint8_t, std::uint8_t>
      fallback;           // class → class to copy from if no exemplar has any texel of it
  int neighbourhood = 7;  // side of the patches that are compared, pixels: 3, 5, 7, 9 or 11; about
                          // the size of the painting's elements
  std::string distance = "ssd";  // of two patches: "ssd", the weighted sum of squared differences
                                 // of R, G and B, or "normalized", the same without the mean
                                 // difference of the patches' lightness
  double reuse = 1.0;            // strength of the reuse penalty, 0…10
  int copy_cap = 240;  // max size of a copied piece, texels at level 0; 16…100000; never exceeded
  // Weight of the classes around a pixel (squared differences of class counts over 17 × 17 pixels),
  // 0…100.
  double surroundings = 1.0;
  std::string surroundings_of = "commonest";  // which of the other classes around count: the
                                              // "commonest" or "all", and each by its share
  // Dissimilarity of two classes as surroundings, 0 (interchangeable) … 1, by pair of labels in
  // either order; absent: 1.
  std::map<std::pair<std::uint8_t, std::uint8_t>, double> class_dissimilarity;
  int patch_radius() const { return neighbourhood / 2; }
  int tile =
      0;  // side of the tiles of one step, 0 (whole rows) or even; does not change the result
};

// The texel and exemplar from which each target pixel is copied: the state of synthesis and also a
// product.
struct Match {
  static constexpr std::uint16_t none =
      0xffff;  // exemplar of a pixel without a texel (its class exists nowhere)
  std::uint16_t exemplar = none;
  std::uint16_t x = 0;
  std::uint16_t y = 0;
  bool operator==(const Match&) const = default;
};

using MatchField = Grid<Match>;

// Copies any layer of the exemplars, at its own bit depth, through a match field. layers[i] belongs
// to exemplar i. Pixels without a match take `missing`'s value there, or T{} where `missing` is
// empty. Throws Error(usage) if `missing` has another size, Error(input) if a match points outside
// its layer.
template <class T>
Grid<T> replay(const MatchField& matches, const std::vector<const Grid<T>*>& layers,
               const Grid<T>& missing) {
  if (!missing.empty() && !missing.same_size(matches)) {
    throw Error(ErrorKind::usage, "match field", "the values for missing pixels have another size",
                "the size of the match field");
  }
  Grid<T> out(matches.width(), matches.height());
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Match m = matches[i];
    if (m.exemplar == Match::none) {
      if (!missing.empty()) out[i] = missing[i];
    } else if (m.exemplar < layers.size() && layers[m.exemplar]->contains(m.x, m.y)) {
      out[i] = (*layers[m.exemplar])(m.x, m.y);
    } else {
      throw Error(ErrorKind::input, "match field", "a match points outside the exemplars");
    }
  }
  return out;
}

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
