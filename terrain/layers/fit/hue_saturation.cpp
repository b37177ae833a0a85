#include "terrain/layers/fit/hue_saturation.h"

#include <algorithm>
#include <cstddef>

#include "base/angle.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {

HueSaturation hue_saturation_of(double r, double g, double b, double grey_range) {
  const double most = std::max({r, g, b});
  const double least = std::min({r, g, b});
  const double range = most - least;
  HueSaturation colour;
  colour.value = most / 255.0;
  colour.saturation = most > 0.0 ? range / most : 0.0;
  colour.grey = range <= grey_range;
  if (range <= 0.0) return colour;
  double sixth = 0.0;
  if (most == r)
    sixth = (g - b) / range + (g < b ? 6.0 : 0.0);
  else if (most == g)
    sixth = (b - r) / range + 2.0;
  else
    sixth = (r - g) / range + 4.0;
  colour.hue_deg = 60.0 * sixth;
  return colour;
}

PlanePlace hue_saturation_place(const HueSaturation& colour) {
  constexpr double grey_share = 0.3;
  const exact::Turn turn = exact::turn(to_radians(colour.hue_deg));
  const double reach = colour.saturation * (colour.grey ? grey_share : 1.0);
  return {reach * turn.cosine, reach * turn.sine};
}

RgbPlanes smooth_chroma(const RgbPlanes& picture, double sigma_cells) {
  const int width = picture.r.width();
  const int height = picture.r.height();
  // Luma of Rec. 601, as JPEG has it.
  Grid<float> luma(width, height);
  Grid<float> red(width, height);
  Grid<float> blue(width, height);
  for (std::size_t i = 0; i != luma.size(); ++i) {
    luma[i] = 0.299F * picture.r[i] + 0.587F * picture.g[i] + 0.114F * picture.b[i];
    red[i] = picture.r[i] - luma[i];
    blue[i] = picture.b[i] - luma[i];
  }
  red = gaussian_blur(red, sigma_cells);
  blue = gaussian_blur(blue, sigma_cells);
  RgbPlanes smooth{std::move(red), Grid<float>(width, height), std::move(blue)};
  parallel_rows(height, [&](int y) {
    for (std::size_t i = luma.index(0, y); i != luma.index(0, y + 1); ++i) {
      const float r = luma[i] + smooth.r[i];
      const float b = luma[i] + smooth.b[i];
      smooth.r[i] = std::clamp(r, 0.0F, 255.0F);
      smooth.g[i] = std::clamp((luma[i] - 0.299F * r - 0.114F * b) / 0.587F, 0.0F, 255.0F);
      smooth.b[i] = std::clamp(b, 0.0F, 255.0F);
    }
  });
  return smooth;
}

}  // namespace belvedere
