#pragma once

#include <array>
#include <cstdint>

#include "texture/statistical/band_pyramid.h"
#include "texture/statistical/clique_model.h"

namespace belvedere {

// Frequencies of the differences of a type, in fixed bins over the whole possible range: ranges of
// one picture would change from round to round.
inline constexpr int difference_bins = 1024;
struct DifferenceHistogram {
  std::array<std::uint32_t, difference_bins> counts{};
  std::uint64_t total = 0;
};

// Histogram of the differences of all cliques of a type whose ends both count and of which at least
// one may change. Integers, so the order of summation does not matter.
DifferenceHistogram count_differences(const BandPicture& picture, const BandSpace& bands,
                                      const CliqueType& type);

CliqueKnots find_knots(const DifferenceHistogram& histogram, const DifferenceRange& range);

// Bins merged into 34 groups defined by an example: 32 even ones between its .5 % and 99.5 %, and
// the two outside.
class HistogramGroups {
 public:
  static constexpr int count = 34;

  HistogramGroups() = default;
  explicit HistogramGroups(const DifferenceHistogram& example);

  // Distances of a histogram to the example, both normalized: the sum of absolute differences, 0…2,
  // and the Euclidean one.
  struct Distance {
    double l1 = 0.0;
    double l2 = 0.0;
  };
  Distance distance(const DifferenceHistogram& histogram) const;

 private:
  std::array<std::uint8_t, difference_bins> group_{};
  std::array<double, count> share_{};
};

// The rows of a picture's cliques: f(tail row, head row, first tail column, first head column,
// cliques), for tail rows y0 <= y < y1.
template <class F>
void clique_rows(int width, int height, const CliqueType& type, int y0, int y1, F&& f) {
  const int first = type.dx < 0 ? -type.dx : 0;
  const int cliques = width - (type.dx < 0 ? -type.dx : type.dx);
  if (cliques <= 0) return;
  const int last = height - type.dy < y1 ? height - type.dy : y1;
  for (int y = y0 > 0 ? y0 : 0; y < last; ++y) f(y, y + type.dy, first, first + type.dx, cliques);
}

}  // namespace belvedere
