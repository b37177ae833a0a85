#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// Figures that distinguish computed pictures from paintings, without labels: compared with those of
// real paintings they show where a picture differs. They do not measure beauty. Lightness is
// OKLab's, 0…1; sizes are in pixels, so bring pictures to one size of stroke first.
struct PaintingFigures {
  static constexpr std::size_t hue_sectors = 12;

  // Share of the chroma (largest - smallest of encoded R, G, B) in each 30° of hue from red (0°)
  // over yellow (60°), green (120°), cyan and blue (240°) to magenta. Sums to 1; all 0 in a picture
  // without colour.
  std::array<double, hue_sectors> hue_shares{};
  double saturation_mean = 0.0;    // of chroma / largest of R, G, B: 0…1
  double saturation_spread = 0.0;  // standard deviation
  double lightness_mean = 0.0;
  double lightness_spread = 0.0;

  // log2(G(s) / G(2s)), G(s) the mean squared gradient of lightness blurred by s pixels: contrast
  // cancels. Edges much softer than s give 0, hard ones far apart 1, detail of every size
  // (paintings, photographs) 1.6…2, grain up to 4. At s = 1 and, coarser, s = 2.
  double sharpness = 0.0;
  double coarse_sharpness = 0.0;

  // Along and across the local direction of paint: three times the distance at which the
  // correlation of lightness (minus its mean within 10 px, in units of its local contrast) has
  // fallen to one half. For opaque strokes at random positions this is their length and width,
  // because two positions s apart belong to one stroke with probability (l - s) / (l + s). At most
  // 120; 0 where nothing has a direction.
  double stroke_length_px = 0.0;
  double stroke_width_px = 0.0;
  // Mean length of the path in both directions through a position along the direction of paint
  // until it has turned by 30° or is lost (coherence below .2): at most 129. Circles of radius R
  // give R π / 3.
  double direction_run_px = 0.0;
  // (λ1 - λ2) / (λ1 + λ2) of the structure tensor over 3 px, weighted by its energy: 0 isotropic, 1
  // one direction.
  double coherence = 0.0;

  // measure_unevenness of the whole picture: computed pictures are too uniform.
  double unevenness = 0.0;
  double flat_share = 0.0;  // of pixels around which (5 × 5) lightness deviates by less than .006
};

// Encoded sRGB, at least 96 pixels on each side: Error(usage). The same for any number of threads.
PaintingFigures measure_painting(const Grid<glm::vec3>& picture);

// Smaller by a factor 0 < scale ≤ 1, each pixel the mean over its area in linear light. The size is
// rounded down, at least one pixel; 1 copies. Error(usage) for other scales: enlarging adds pixels
// and no paint.
Grid<glm::vec3> shrink_picture(const Grid<glm::vec3>& encoded, double scale);

}  // namespace belvedere
