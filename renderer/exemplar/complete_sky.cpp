#include "renderer/exemplar/complete_sky.h"

#include <algorithm>
#include <glm/vec2.hpp>
#include <vector>

#include "base/land_cover_class.h"
#include "base/masks/label_blur.h"

namespace belvedere {
namespace {

constexpr auto mask_sky = static_cast<std::uint8_t>(LandCoverClass::sky);
constexpr double min_sky_share = 0.01;    // of a picture that shows sky
constexpr double min_edge_share = 0.5;    // of the upper edge, covered by an unnoticed sky
constexpr double min_enclosed = 0.75;     // share of an outline that borders on sky
constexpr double max_mean_height = 0.45;  // 0 upper edge … 1 lower edge

// Position of a connected part of one class, and what it borders on.
struct PartLayout {
  double mean_height = 0.0;  // 0 upper edge … 1 lower edge
  double edge_share = 0.0;   // of the upper edge of the picture
  double outline = 0.0;      // sides of pixels that border on other parts
  double beside_sky = 0.0;   // of these
  bool lowest = false;       // touches the lower edge: ground below the sky
};

using MaskParts = LabelPatches<std::uint8_t>;

MaskParts mask_parts(const Grid<std::uint8_t>& mask) {
  return find_patches(mask, [](std::uint8_t) { return false; });
}

std::vector<PartLayout> layout_of(const Grid<std::uint8_t>& mask, const MaskParts& parts) {
  std::vector<PartLayout> layout(parts.sizes.size());
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) {
      const std::uint32_t p = parts.of_cell(x, y);
      PartLayout& part = layout[p];
      part.mean_height += y / (static_cast<double>(parts.sizes[p]) * mask.height());
      if (y == 0) part.edge_share += 1.0 / mask.width();
      part.lowest = part.lowest || y + 1 == mask.height();
      for (const glm::ivec2 to : {glm::ivec2(x + 1, y), glm::ivec2(x - 1, y), glm::ivec2(x, y + 1),
                                  glm::ivec2(x, y - 1)}) {
        if (!mask.contains(to.x, to.y) || mask(to.x, to.y) == mask(x, y)) continue;
        part.outline += 1.0;
        part.beside_sky += mask(to.x, to.y) == mask_sky ? 1.0 : 0.0;
      }
    }
  return layout;
}

}  // namespace

Grid<std::uint8_t> complete_sky(Grid<std::uint8_t> mask) {
  const auto sky = std::count(mask.begin(), mask.end(), mask_sky);
  if (static_cast<double>(sky) < min_sky_share * static_cast<double>(mask.size())) {
    const MaskParts parts = mask_parts(mask);
    const std::vector<PartLayout> layout = layout_of(mask, parts);
    const auto top = std::max_element(
        layout.begin(), layout.end(),
        [](const PartLayout& a, const PartLayout& b) { return a.edge_share < b.edge_share; });
    if (top->edge_share < min_edge_share || top->mean_height > max_mean_height) return mask;
    const auto number = static_cast<std::uint32_t>(top - layout.begin());
    for (std::size_t i = 0; i < mask.size(); ++i)
      if (parts.of_cell[i] == number) mask[i] = mask_sky;
  }
  // Twice: a star may lie in a halo of another class.
  for (int pass = 0; pass < 2; ++pass) {
    const MaskParts parts = mask_parts(mask);
    const std::vector<PartLayout> layout = layout_of(mask, parts);
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const PartLayout& part = layout[parts.of_cell[i]];
      if (!part.lowest && part.outline > 0.0 && part.beside_sky >= min_enclosed * part.outline)
        mask[i] = mask_sky;
    }
  }
  return mask;
}

}  // namespace belvedere
