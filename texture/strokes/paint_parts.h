#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "base/grid.h"
#include "base/pixel_rect.h"

namespace belvedere {

// What paint is part of, for who wants it by layers; features: roads, lifts and runs, which are laid over strokes.
enum class PaintPart : std::uint8_t { sky, ground, ice, trees, houses, accents, features };
inline constexpr std::size_t paint_part_count = 7;

// How much of each part's paint is seen, and in which colour. Painting is alpha blending, so what a pixel shows is a sum: the canvas times
// what is left of it, and each stroke's colour times what later strokes leave of its opacity. Added up by parts these sums say which
// layers, laid one over the other in any fixed order, make the picture again, though strokes of all parts lie far to near among each other.
class PaintParts {
 public:
  // Pixels of the canvas that are kept.
  explicit PaintParts(PixelRect rect) : rect_(rect) {
    for (Grid<glm::vec4>& sum : sums_) sum = Grid<glm::vec4>(rect.width(), rect.height(), glm::vec4(0.0F));
  }
  PixelRect rect() const { return rect_; }
  // A stroke lays paint of opacity alpha on pixel x, y of the canvas, in `rect`.
  void cover(int x, int y, PaintPart part, float alpha, glm::vec3 colour) {
    const std::size_t i = sums_[0].index(x - rect_.x0, y - rect_.y0);
    for (Grid<glm::vec4>& sum : sums_) sum[i] *= 1.0F - alpha;
    sums_[static_cast<std::size_t>(part)][i] += alpha * glm::vec4(colour, 1.0F);
  }
  // Thins what was painted since `before` to 1 - share, a share 0…1 for each pixel of the canvas.
  void thin_since(const PaintParts& before, const Grid<float>& share) {
    for (std::size_t k = 0; k < sums_.size(); ++k)
      for (int y = rect_.y0; y < rect_.y1; ++y)
        for (int x = rect_.x0; x < rect_.x1; ++x) {
          glm::vec4& sum = sums_[k](x - rect_.x0, y - rect_.y0);
          sum += share(x, y) * (before.sums_[k](x - rect_.x0, y - rect_.y0) - sum);
        }
  }
  // Colours times weights, and the weights, 0…1; what all weights leave of 1 is the canvas.
  const Grid<glm::vec4>& sum(PaintPart part) const { return sums_[static_cast<std::size_t>(part)]; }

 private:
  PixelRect rect_;
  std::array<Grid<glm::vec4>, paint_part_count> sums_;
};

}  // namespace belvedere
