#include "renderer/trace/wide_view.h"

#include <cmath>

namespace belvedere {
namespace {

constexpr double least_pixels_per_unit = 2.0;  // of a wide view

}  // namespace

int wide_factor(double pixels_per_unit) { return std::max(1, static_cast<int>(std::floor(pixels_per_unit / least_pixels_per_unit))); }

PixelRect wide_rect(PixelRect r, int factor) {
  const auto down = [factor](int v) { return v >= 0 ? v / factor : -((-v + factor - 1) / factor); };
  return grown({down(r.x0), down(r.y0), down(r.x1 + factor - 1), down(r.y1 + factor - 1)}, factor == 1 ? 0 : 1);
}

}  // namespace belvedere
