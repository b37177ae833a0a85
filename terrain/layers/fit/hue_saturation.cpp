#include "terrain/layers/fit/hue_saturation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/common.hpp>

#include "base/math.h"
#include "base/filter.h"
#include "base/math_exact.h"

namespace belvedere {

HueSaturation hue_saturation_of(const glm::dvec3& rgb, double grey_range) {
  const auto [r, g, b] = std::array{rgb.x, rgb.y, rgb.z};
  const double max = std::max({r, g, b});
  const double min = std::min({r, g, b});
  const double range = max - min;
  HueSaturation colour;
  colour.value = max / 255.0;
  colour.saturation = max > 0.0 ? range / max : 0.0;
  colour.grey = range <= grey_range;
  if (range <= 0.0) return colour;
  double sixth = 0.0;
  if (max == r)
    sixth = (g - b) / range + (g < b ? 6.0 : 0.0);
  else if (max == g)
    sixth = (b - r) / range + 2.0;
  else
    sixth = (r - g) / range + 4.0;
  colour.hue_deg = 60.0 * sixth;
  return colour;
}

PlanePosition hue_saturation_place(const HueSaturation& colour) {
  constexpr double grey_share = 0.3;
  const exact::Turn turn = exact::turn(to_radians(colour.hue_deg));
  const double reach = colour.saturation * (colour.grey ? grey_share : 1.0);
  return {reach * turn.cosine, reach * turn.sine};
}

Grid<glm::vec3> smooth_chroma(const Grid<glm::vec3>& picture, double sigma_cells) {
  const int width = picture.width();
  const int height = picture.height();
  // Luma of Rec. 601, as in JPEG.
  Grid<float> luma(width, height);
  Grid<float> red(width, height);
  Grid<float> blue(width, height);
  for (std::size_t i = 0; i != luma.size(); ++i) {
    luma[i] = 0.299F * picture[i].x + 0.587F * picture[i].y + 0.114F * picture[i].z;
    red[i] = picture[i].x - luma[i];
    blue[i] = picture[i].z - luma[i];
  }
  red = gaussian_blur(red, sigma_cells);
  blue = gaussian_blur(blue, sigma_cells);
  Grid<glm::vec3> smooth(width, height);
  for (std::size_t i = 0; i != smooth.size(); ++i) {
    const float r = luma[i] + red[i];
    const float b = luma[i] + blue[i];
    smooth[i] =
        glm::clamp(glm::vec3(r, (luma[i] - 0.299F * r - 0.114F * b) / 0.587F, b), 0.0F, 255.0F);
  }
  return smooth;
}

}  // namespace belvedere
