#include "renderer/exemplar/complete_sky.h"

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "base/land_cover_class.h"

namespace belvedere {
namespace {

constexpr auto mask_sky = static_cast<std::uint8_t>(LandCoverClass::sky);
constexpr double min_sky_share = 0.01;    // of a picture that shows sky
constexpr double min_edge_share = 0.5;    // of the upper edge, covered by an unnoticed sky
constexpr double min_enclosed = 0.75;     // share of an outline that borders on sky
constexpr double max_mean_height = 0.45;  // 0 upper edge … 1 lower edge

// A connected part of one class.
struct MaskPart {
  std::vector<std::size_t> pixels;
  double mean_height = 0.0;
  double edge_share = 0.0;  // of the upper edge of the picture
  double enclosed = 0.0;    // share of its outline, within the picture, that borders on sky
};

std::vector<MaskPart> mask_parts(const Grid<std::uint8_t>& mask) {
  std::vector<MaskPart> parts;
  Grid<std::uint8_t> seen(mask.width(), mask.height(), 0);
  std::vector<glm::ivec2> open;
  for (int v = 0; v < mask.height(); ++v)
    for (int u = 0; u < mask.width(); ++u) {
      if (seen(u, v) != 0) continue;
      const std::uint8_t label = mask(u, v);
      MaskPart part;
      double beside_sky = 0.0;
      double outline = 0.0;
      bool lowest = false;  // touches the lower edge: ground below the sky
      seen(u, v) = 1;
      open.push_back({u, v});
      while (!open.empty()) {
        const glm::ivec2 at = open.back();
        open.pop_back();
        part.pixels.push_back(mask.index(at.x, at.y));
        part.mean_height += at.y;
        lowest = lowest || at.y + 1 == mask.height();
        if (at.y == 0) part.edge_share += 1.0 / mask.width();
        for (const glm::ivec2 to : std::array<glm::ivec2, 4>{
                 {{at.x + 1, at.y}, {at.x - 1, at.y}, {at.x, at.y + 1}, {at.x, at.y - 1}}}) {
          if (!mask.contains(to.x, to.y)) continue;
          if (mask(to.x, to.y) == label) {
            if (seen(to.x, to.y) != 0) continue;
            seen(to.x, to.y) = 1;
            open.push_back(to);
          } else {
            outline += 1.0;
            beside_sky += mask(to.x, to.y) == mask_sky ? 1.0 : 0.0;
          }
        }
      }
      part.mean_height /= static_cast<double>(part.pixels.size()) * mask.height();
      part.enclosed = outline > 0.0 && !lowest ? beside_sky / outline : 0.0;
      parts.push_back(std::move(part));
    }
  return parts;
}

void fill_part(Grid<std::uint8_t>& mask, const MaskPart& part) {
  for (const std::size_t i : part.pixels) mask[i] = mask_sky;
}

}  // namespace

Grid<std::uint8_t> complete_sky(Grid<std::uint8_t> mask) {
  const auto sky = std::count(mask.begin(), mask.end(), mask_sky);
  if (static_cast<double>(sky) < min_sky_share * static_cast<double>(mask.size())) {
    const std::vector<MaskPart> parts = mask_parts(mask);
    const auto top = std::max_element(
        parts.begin(), parts.end(),
        [](const MaskPart& a, const MaskPart& b) { return a.edge_share < b.edge_share; });
    if (top->edge_share < min_edge_share || top->mean_height > max_mean_height) return mask;
    fill_part(mask, *top);
  }
  // Twice: a star may lie in a halo of another class.
  for (int pass = 0; pass < 2; ++pass)
    for (const MaskPart& part : mask_parts(mask))
      if (part.enclosed >= min_enclosed && mask[part.pixels.front()] != mask_sky)
        fill_part(mask, part);
  return mask;
}

}  // namespace belvedere
