#include "renderer/paint/range_edges.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random_streams.h"
#include "renderer/paint/picture_noise.h"

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

Grid<float> hollow_mist_places(std::uint64_t seed, glm::ivec2 origin_px, int width, int height,
                               double pixels_per_unit) {
  constexpr std::uint64_t first_part = 64;  // lower ones are those of mist layers
  const auto noise = [&](std::uint64_t part, double sigma_x, double sigma_y) {
    return make_image_noise(stream_seed(seed, Stream::mist_patches, first_part + part), origin_px,
                            width, height, pixels_per_unit, sigma_x, sigma_y);
  };
  Grid<float> places = noise(0, 69.0, 17.0);
  const Grid<float> small = noise(1, 23.0, 8.0);
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = smoothstep(-0.7F, 1.1F, places[i] + 0.4F * small[i]);
  return places;
}

float hollow_mist(float place, float relief_l_m, float slope_deg, float strength) {
  constexpr float deepest = 0.32F;
  constexpr float max = 0.8F;
  constexpr float on_floors = 0.35F;
  const float steep = smoothstep(4.0F, 16.0F, slope_deg);
  return std::min(deepest * strength, max) * (on_floors + (1.0F - on_floors) * steep) *
         (1.0F - smoothstep(-160.0F, 60.0F, relief_l_m)) * place;
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
