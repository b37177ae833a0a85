#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/guide_stack.h"
#include "texture/synthesis/match_field.h"

namespace belvedere {

// How unlike two colours are; summed over a neighbourhood it is the distance of two neighbourhoods.
struct ColourDistance {
  std::string_view name;
  std::string_view meaning;
  std::int32_t (*between)(const Rgb8& a, const Rgb8& b) = nullptr;  // ≥ 0, 0 for the same colour, at most `largest`
  std::int32_t largest = 0;
};
// The one table of distances: "squares" (of differences of R, G, B), "absolute", "grey".
std::span<const ColourDistance> colour_distances();
const ColourDistance* find_colour_distance(std::string_view name);  // null: there is none of that name

struct BasicParameters {
  int neighbourhood = 7;  // side of the square whose upper half is compared, pixels: 3, 5 … 31
  ColourDistance distance = colour_distances().front();
  std::vector<std::pair<std::string, double>> weights = {};  // by guide name; absent: 1; 0 …
  // Price of other classes around (Σ_k (n_k(pixel) - n_k(texel))², n_k the share of class k in the whole square, in 255ths), 0 … infinity:
  // with infinity a texel with other classes around is taken only where there is none better.
  double land_cover = 1.0;
  std::map<std::uint8_t, std::uint8_t> fallback = {};  // class → class it is counted as where no exemplar has any texel of it
  // Only what continues a neighbour's copy is looked at, and all texels where there is no such: Ashikhmin's candidates (Synthesizing
  // natural textures, 2001), as Jenny & Jenny (2013) use them.
  bool coherent = false;
  std::uint64_t seed = 1;  // of the first pixel, where all cost the same
};

// Texture synthesis as Wei & Levoy (2000) and Jenny & Jenny (2013) state it, plain and slow: row by row every pixel copies the texel whose
// neighbours above and to the left, an L, are most like those that are made already,
//   C = mean distance over the L + land_cover × D_lc + Σ 6.2 × weight × (difference of a guide, 0…255)²,
// over all texels; 6.2 makes a weight count as in synthesize. What faster synthesis is measured against, and an oracle: no texel costs less
// than the one taken (ties: the first by exemplar, row, column). A neighbour that the exemplar lacks costs `largest`. Pixels and texels of
// unused_label are left out and compared with nothing. The same for any threads.
//
// Throws Error(usage) for what does not fit, Error(limit) for more than 10¹² comparisons of a pixel with a texel.
MatchField synthesize_basic(const std::vector<Exemplar>& exemplars, const GuideStack& target, const BasicParameters& parameters,
                            Progress& progress);

}  // namespace belvedere
