#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace belvedere {

struct SynthesisParameters {
  std::uint64_t seed = 1;
  int levels = 6;  // 1…8, fewer if the smallest side would be under 16
  std::vector<std::pair<std::string, double>>
      weights;  // by guide name; absent: 1; 0 switches a guide off; 0…100
  std::map<std::uint8_t, std::uint8_t>
      fallback;           // class → class to copy from if no exemplar has any texel of it
  int neighbourhood = 7;  // side of the patches that are compared, pixels: 3, 5, 7, 9 or 11; about
                          // the size of the painting's elements
  double reuse = 1.0;     // strength of the reuse penalty, 0…10
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

}  // namespace belvedere
