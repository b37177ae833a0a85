#include "texture/strokes/paint_parts.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// The sums are the painting: the remaining canvas plus the sums equals alpha blending in that
// order.
TEST(PaintParts, SumsMakeThePaintingInAnyOrderOfParts) {
  const PixelRect rect{5, 7, 25, 17};
  PaintParts parts(rect);
  Grid<glm::vec3> canvas(30, 20);
  for (std::size_t i = 0; i < canvas.size(); ++i)
    canvas[i] = glm::vec3(static_cast<float>(random_uniform(1, static_cast<int>(i), 0, 0)));
  const Grid<glm::vec3> bare = canvas;
  for (int stroke = 0; stroke < 300; ++stroke) {
    const auto draw = [&](std::uint64_t n) { return random_uniform(2, stroke, 0, n); };
    const int x = rect.x0 + static_cast<int>(draw(0) * rect.width());
    const int y = rect.y0 + static_cast<int>(draw(1) * rect.height());
    const auto alpha = static_cast<float>(draw(2));
    const glm::vec3 colour(static_cast<float>(draw(3)), static_cast<float>(draw(4)), 0.5F);
    const auto part = static_cast<PaintPart>(static_cast<int>(draw(5) * 7.0));
    for (int v = y; v < rect.y1; ++v) {
      canvas(x, v) += alpha * (colour - canvas(x, v));
      parts.cover(x, v, part, alpha, colour);
    }
  }
  for (const auto [x, y] : test::cells(rect)) {
    glm::vec4 sum(0.0F);
    for (std::size_t k = 0; k < paint_part_count; ++k)
      sum += parts.sum(static_cast<PaintPart>(k))(x - rect.x0, y - rect.y0);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(sum[c] + (1.0F - sum.w) * bare(x, y)[c], canvas(x, y)[c], 1e-5F) << x << " " << y;
  }
}

// Thinning mixes the parts with their earlier state.
TEST(PaintParts, PaintCanBeThinnedToWhatWasThere) {
  const PixelRect rect{5, 7, 8, 9};
  PaintParts parts(rect);
  parts.cover(6, 8, PaintPart::trees, 0.5F, {0.2F, 0.4F, 0.6F});
  const PaintParts before = parts;
  parts.cover(6, 8, PaintPart::features, 0.8F, glm::vec3(1.0F));
  Grid<float> share(30, 20, 1.0F);
  share(6, 8) = 0.25F;
  parts.thin_since(before, share);
  EXPECT_NEAR(parts.sum(PaintPart::features)(1, 1).w, 0.75F * 0.8F, 1e-6F);
  EXPECT_NEAR(parts.sum(PaintPart::trees)(1, 1).w, 0.5F * (0.25F + 0.75F * 0.2F), 1e-6F);
  EXPECT_NEAR(parts.sum(PaintPart::trees)(1, 1).y, 0.4F * 0.5F * (0.25F + 0.75F * 0.2F), 1e-6F);
}

}  // namespace
}  // namespace belvedere
