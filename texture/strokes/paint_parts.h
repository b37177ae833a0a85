#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "base/grid.h"
#include "base/pixel_rect.h"

namespace belvedere {

// The part of the picture that paint belongs to, for layers; features: roads, lifts and runs, which
// are painted over strokes.
enum class PaintPart : std::uint8_t { sky, ground, ice, trees, houses, accents, features };
inline constexpr std::size_t paint_part_count = 7;

// The visible amount of each part's paint, and its colour. Painting is alpha blending, so a pixel
// is a sum: the canvas times its remaining share, and each stroke's colour times the share of its
// opacity that later strokes leave. Summed by parts, this gives layers that reproduce the picture
// when composited in a fixed order, although strokes of all parts are mixed from far to near.
class PaintParts {
 public:
  // Pixels of the canvas for which sums are kept.
  explicit PaintParts(PixelRect rect) : rect_(rect) {
    for (Grid<glm::vec4>& sum : sums_)
      sum = Grid<glm::vec4>(rect.width(), rect.height(), glm::vec4(0.0F));
  }
  PixelRect rect() const { return rect_; }
  // A stroke lays paint of opacity alpha on pixel x, y of the canvas, in `rect`.
  void cover(int x, int y, PaintPart part, float alpha, glm::vec3 colour) {
    const std::size_t i = sums_[0].index(x - rect_.x0, y - rect_.y0);
    for (Grid<glm::vec4>& sum : sums_) sum[i] *= 1.0F - alpha;
    sums_[static_cast<std::size_t>(part)][i] += alpha * glm::vec4(colour, 1.0F);
  }
  // Reduces the paint since `before` to 1 - share, a share 0…1 for each pixel of the canvas.
  void thin_since(const PaintParts& before, const Grid<float>& share) {
    for (std::size_t k = 0; k < sums_.size(); ++k)
      for (int y = rect_.y0; y < rect_.y1; ++y)
        for (int x = rect_.x0; x < rect_.x1; ++x) {
          glm::vec4& sum = sums_[k](x - rect_.x0, y - rect_.y0);
          sum += share(x, y) * (before.sums_[k](x - rect_.x0, y - rect_.y0) - sum);
        }
  }
  // Colours times weights, and the weights, 0…1; the canvas has the rest of 1.
  const Grid<glm::vec4>& sum(PaintPart part) const { return sums_[static_cast<std::size_t>(part)]; }

 private:
  PixelRect rect_;
  std::array<Grid<glm::vec4>, paint_part_count> sums_;
};

}  // namespace belvedere
