#include "renderer/trace/wide_view.h"

#include <cmath>

#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr double min_pixels_per_unit = 2.0;  // of a wide view

}  // namespace

int wide_factor(double pixels_per_unit) {
  return std::max(1, static_cast<int>(std::floor(pixels_per_unit / min_pixels_per_unit)));
}

glm::ivec2 thinned_origin(const WideView& wide, int times) { return wide.origin_px / times; }

GuidanceBuffers thin_out(const WideView& wide, int times) {
  const GuidanceBuffers& seen = wide.seen;
  const glm::ivec2 first = thinned_origin(wide, times);
  const glm::ivec2 size =
      (wide.origin_px + glm::ivec2(seen.width(), seen.height()) + times - 1) / times - first;
  GuidanceBuffers thin;
  thin.origin_m = seen.origin_m;
  thin.depth_m = thin.footprint_m = Grid<float>(size.x, size.y);
  thin.land_cover = Grid<LandCoverClass>(size.x, size.y);
  thin.fall_line = Grid<glm::vec2>(size.x, size.y);
  thin.normal = Grid<glm::vec3>(size.x, size.y);
  parallel_ranges(size.y, 16, [&](int begin, int end) {
    for (int y = begin; y != end; ++y)
      for (int x = 0; x < size.x; ++x) {
        const glm::ivec2 centre = (first + glm::ivec2(x, y)) * times + times / 2 - wide.origin_px;
        const std::size_t from = seen.depth_m.index(std::clamp(centre.x, 0, seen.width() - 1),
                                                    std::clamp(centre.y, 0, seen.height() - 1));
        const std::size_t to = thin.depth_m.index(x, y);
        thin.depth_m[to] = seen.depth_m[from];
        thin.footprint_m[to] = seen.footprint_m[from] * static_cast<float>(times);
        thin.land_cover[to] = seen.land_cover[from];
        thin.fall_line[to] = seen.fall_line[from];
        thin.normal[to] = seen.normal[from];
      }
  });
  return thin;
}

PixelRect wide_rect(PixelRect r, int factor) {
  const auto down = [factor](int v) { return v >= 0 ? v / factor : -((-v + factor - 1) / factor); };
  return grown({down(r.x0), down(r.y0), down(r.x1 + factor - 1), down(r.y1 + factor - 1)},
               factor == 1 ? 0 : 1);
}

}  // namespace belvedere
