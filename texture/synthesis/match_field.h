#pragma once

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "base/grid.h"

namespace belvedere {

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

}  // namespace belvedere
