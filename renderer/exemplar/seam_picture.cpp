#include "renderer/exemplar/seam_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/filter.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

// Deviation of a texel's brightness from its surroundings for which the costs of synthesis are
// tuned, encoded sRGB: strong, even strokes.
constexpr double tuned_contrast = 14.0 / 255.0;
constexpr double around_texels = 2.0;

}  // namespace

Grid<Rgb8> seam_picture(const PaintedExemplar& painted, const Grid<std::uint8_t>& labels,
                        double residual) {
  const Grid<glm::vec3>& picture = painted.picture;
  Grid<glm::vec3> carried = picture;
  if (!painted.base.empty())
    for (std::size_t i = 0; i < carried.size(); ++i)
      carried[i] -= static_cast<float>(residual) * painted.base[i];
  Grid<float> brightness(carried.width(), carried.height());
  for (std::size_t i = 0; i < carried.size(); ++i)
    brightness[i] = (carried[i].x + carried[i].y + carried[i].z) / 3.F;
  const Grid<float> around = gaussian_blur(brightness, around_texels);

  struct Sums {
    glm::dvec3 colour{0.0};
    double squares = 0.0;
    double count = 0.0;
  };
  std::array<Sums, 256> sums{};
  for (std::size_t i = 0; i < carried.size(); ++i) {
    Sums& s = sums[labels[i]];
    const double detail = brightness[i] - around[i];
    s.colour += glm::dvec3(carried[i]);
    s.squares += detail * detail;
    s.count += 1.0;
  }
  std::array<glm::vec3, 256> centre{};
  std::array<float, 256> gain{};
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const double count = std::max(1.0, sums[k].count);
    centre[k] = glm::vec3(sums[k].colour / count);
    gain[k] = static_cast<float>(
        std::clamp(tuned_contrast / std::sqrt(sums[k].squares / count + 1e-12), 1.0, 8.0));
  }
  Grid<Rgb8> seams(picture.width(), picture.height());
  for (std::size_t i = 0; i < seams.size(); ++i) {
    const std::uint8_t k = labels[i];
    seams[i] = to_rgb8(glm::vec3(0.5F) + gain[k] * (carried[i] - centre[k]));
  }
  return seams;
}

}  // namespace belvedere
