#include "texture/composite/composite_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "texture/statistical/difference_histogram.h"

namespace belvedere {
namespace {

constexpr std::size_t strips = 16;
constexpr std::size_t cells = 8 * 8 * 8;

std::vector<double> colour_profile(const Grid<Rgb8>& picture) {
  std::vector<double> shares(strips * cells, 0.0);
  std::array<double, strips> pixels{};
  for (int y = 0; y < picture.height(); ++y) {
    const auto strip =
        static_cast<std::size_t>(y) * strips / static_cast<std::size_t>(picture.height());
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb8& c = picture(x, y);
      const std::size_t cell = (static_cast<std::size_t>(c[0]) >> 5) * 64 +
                               (static_cast<std::size_t>(c[1]) >> 5) * 8 + (c[2] >> 5);
      shares[strip * cells + cell] += 1.0;
    }
    pixels[strip] += picture.width();
  }
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] /= std::max(1.0, pixels[i / cells]);
  return shares;
}

}  // namespace

LayoutFigures layout_figures(const Grid<Rgb8>& crop, const Grid<Rgb8>& made) {
  LayoutFigures figures;
  const std::vector<double> wanted = colour_profile(crop);
  const std::vector<double> found = colour_profile(made);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    figures.profile += std::abs(wanted[i] - found[i]) / strips;

  const BandSpace bands = find_bands(crop, {});
  const BandPicture one = to_bands(crop, bands, {});
  const BandPicture other = to_bands(made, bands, {});
  int types = 0;
  for (const int far : {16, 32, 64, 128}) {
    for (const bool along : {true, false}) {
      if (far >=
          std::min(along ? crop.width() : crop.height(), along ? made.width() : made.height()))
        continue;
      for (int band = 0; band < 3; ++band) {
        const CliqueType type{0, along ? far : 0, along ? 0 : far, band, band};
        figures.far_pairs += HistogramGroups(count_differences(one, bands, type))
                                 .distance(count_differences(other, bands, type))
                                 .l1;
        ++types;
      }
    }
  }
  figures.far_pairs /= std::max(types, 1);
  return figures;
}

}  // namespace belvedere
