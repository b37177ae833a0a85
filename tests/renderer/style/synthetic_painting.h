#pragma once

#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "tests/grids.h"

namespace belvedere::test {

constexpr std::uint8_t label_of(LandCoverClass id) { return static_cast<std::uint8_t>(id); }

// Opaque strokes of one length and width at random positions over a lightness of `middle`, each
// with a random lightness within ± `contrast`; ends and sides are sharp.
inline Grid<glm::vec3> thrown_strokes(int width, int height, double length_px, double width_px,
                                      double angle_rad, double middle = 0.6,
                                      double contrast = 0.15) {
  Grid<glm::vec3> lab(width, height, glm::vec3(static_cast<float>(middle), 0.02F, 0.05F));
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  const int count = static_cast<int>(6.0 * width * height / (length_px * width_px));
  const int reach = static_cast<int>(0.5 * (length_px + width_px)) + 2;
  for (int i = 0; i < count; ++i) {
    const double x0 = random_uniform(11, i, 0) * width;
    const double y0 = random_uniform(11, i, 1) * height;
    const auto lightness =
        static_cast<float>(middle + contrast * (2.0 * random_uniform(11, i, 2) - 1.0));
    for (int y = static_cast<int>(y0) - reach; y <= static_cast<int>(y0) + reach; ++y)
      for (int x = static_cast<int>(x0) - reach; x <= static_cast<int>(x0) + reach; ++x) {
        if (!lab.contains(x, y)) continue;
        const double u = (x + 0.5 - x0) * c + (y + 0.5 - y0) * s;
        const double v = -(x + 0.5 - x0) * s + (y + 0.5 - y0) * c;
        if (std::abs(u) <= 0.5 * length_px && std::abs(v) <= 0.5 * width_px)
          lab(x, y).x = lightness;
      }
  }
  return lab;
}

// A landscape of bands, each with its own colour (OKLab) and noise of lightness: sky, snow,
// rock, forest, pasture.
struct Landscape {
  Grid<glm::vec3> lab;
  Grid<glm::vec3> picture;  // encoded sRGB
  Grid<std::uint8_t> mask;
};

inline Landscape make_landscape(int width = 160, int height = 120) {
  struct Band {
    LandCoverClass id;
    glm::vec3 colour;
  };
  using enum LandCoverClass;
  const std::array<Band, 5> bands = {{{sky, {0.80F, -0.02F, -0.06F}},
                                      {snow, {0.90F, 0.00F, 0.01F}},
                                      {rock, {0.60F, 0.02F, 0.03F}},
                                      {forest, {0.40F, -0.04F, 0.04F}},
                                      {pasture, {0.65F, -0.05F, 0.09F}}}};
  Landscape out{Grid<glm::vec3>(width, height), Grid<glm::vec3>(width, height),
                Grid<std::uint8_t>(width, height)};
  for (const auto [x, y] : test::cells(width, height)) {
    const Band& band = bands[static_cast<std::size_t>(y * 5 / height)];
    out.mask(x, y) = label_of(band.id);
    out.lab(x, y) = band.colour;
    out.lab(x, y).x += 0.04F * static_cast<float>(gaussian_noise(5, x, y, 3.0, 1.5));
    out.picture(x, y) = glm::clamp(from_oklab(out.lab(x, y)), 0.0F, 1.0F);
  }
  return out;
}

}  // namespace belvedere::test
