#include "renderer/exemplar/painting_strokes.h"

#include <cmath>

#include "base/masks/label_blur.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "renderer/image/oklab.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

constexpr double around_strokes = 1.5;  // sigma of the mean over neighbours, in widths of a stroke
constexpr float min_coherence = 0.2F;   // (λ1 - λ2) / (λ1 + λ2): 0 no direction, 1 lines
constexpr float min_variation =
    1e-7F;  // of squared gradients of lightness; below this, paint is flat
constexpr float steepness_of_lying = 0.26F;  // sine of 15°

}  // namespace

Grid<glm::vec2> find_stroke_direction(const Grid<glm::vec3>& picture,
                                      const Grid<std::uint8_t>& labels, double stroke_px) {
  const int width = picture.width();
  const int height = picture.height();
  Grid<float> lightness(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) lightness(x, y) = static_cast<float>(to_oklab(picture(x, y)).x);
  });
  Grid<float> xx(width, height, 0.F);
  Grid<float> xy(width, height, 0.F);
  Grid<float> yy(width, height, 0.F);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::uint8_t label = labels(x, y);
      if (label == unused_label) continue;
      bool inside = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
      for (int v = -1; v <= 1 && inside; ++v)
        for (int u = -1; u <= 1 && inside; ++u) inside = labels(x + u, y + v) == label;
      if (!inside) continue;
      // Scharr's weights: the direction is accurate to a tenth of a degree.
      const auto at = [&](int u, int v) { return lightness(x + u, y + v); };
      const float gx = (3.F * (at(1, -1) - at(-1, -1)) + 10.F * (at(1, 0) - at(-1, 0)) +
                        3.F * (at(1, 1) - at(-1, 1))) /
                       32.F;
      const float gy = (3.F * (at(-1, 1) - at(-1, -1)) + 10.F * (at(0, 1) - at(0, -1)) +
                        3.F * (at(1, 1) - at(1, -1))) /
                       32.F;
      xx(x, y) = gx * gx;
      xy(x, y) = gx * gy;
      yy(x, y) = gy * gy;
    }
  });
  const double sigma = around_strokes * stroke_px;
  xx = blur_within_labels(xx, labels, sigma);
  xy = blur_within_labels(xy, labels, sigma);
  yy = blur_within_labels(yy, labels, sigma);
  Grid<glm::vec2> direction(width, height, glm::vec2(0.F));
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = direction.index(x, y);
      const float sum = xx[i] + yy[i];
      const double difference = xx[i] - yy[i];
      const double twice = 2.0 * static_cast<double>(xy[i]);
      if (sum < min_variation || std::sqrt(difference * difference + twice * twice) <
                                     static_cast<double>(min_coherence * sum))
        continue;
      const double across =
          0.5 * exact::atan2(
                    twice, difference);  // of the steepest change of lightness: across the strokes
      glm::vec2 along(static_cast<float>(-exact::sin(across)),
                      static_cast<float>(exact::cos(across)));
      if (along.y < 0.F) along = -along;
      if (along.y >= steepness_of_lying) direction[i] = along;
    }
  });
  return direction;
}

}  // namespace belvedere
