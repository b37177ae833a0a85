#include "renderer/paint/range_edges.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr float unknown_sky_depth_m = 92000.0F;

}  // namespace

Grid<float> log_depths(const GuidanceBuffers& g, int reach_px) {
  Grid<float> logs(g.width(), g.height());
  parallel_rows(g.height(), [&](int y) {
    for (int x = 0; x < g.width(); ++x) {
      float depth = g.depth_m(x, y);
      if (std::isinf(depth)) {
        depth = unknown_sky_depth_m;
        for (int k = 1; k <= reach_px && y + k < g.height(); ++k)
          if (!std::isinf(g.depth_m(x, y + k))) {
            depth = 1.02F * g.depth_m(x, y + k);
            break;
          }
      }
      logs(x, y) = static_cast<float>(exact::log(static_cast<double>(std::max(depth, 1.0F))));
    }
  });
  return logs;
}

RangeEdge range_edge(float behind, float far, float raised, float strength) {
  const float low = 1.0F - 0.75F * std::max(raised, 0.0F);
  return {std::clamp((3.0F + 5.0F * far) * behind, 0.0F, 0.35F + 0.20F * std::min(far, 1.0F)) *
              strength * low,
          std::clamp(-(1.5F + 4.0F * far) * behind, 0.0F, 0.25F + 0.10F * std::min(far, 1.0F)) *
              strength};
}

float accent_at(const GuidanceBuffers& g, const Grid<float>& log_depth, int x, int y, int step_px) {
  const auto beside = [&](int nx, int ny) { return log_depth.clamped(nx, ny); };
  float jump =
      std::max(beside(x, y - step_px), std::max(beside(x - step_px, y), beside(x + step_px, y))) -
      log_depth(x, y);
  for (int k = 1; k <= 3; ++k) {
    const auto sky = [&](int nx, int ny) { return std::isinf(g.depth_m.clamped(nx, ny)); };
    if (sky(x, y - k * step_px) || sky(x - k * step_px, y) || sky(x + k * step_px, y)) jump = 0.0F;
  }
  const float edge = unit(14.0F * jump);
  if (edge > 0.3F) return (g.tone(x, y) > 0.45F ? 0.8F : -0.8F) * edge;
  return class_info(g.land_cover(x, y)).hue.relief_accent *
         std::clamp(g.relief_s_m(x, y) / 9.0F, -1.0F, 1.0F);
}

}  // namespace belvedere
