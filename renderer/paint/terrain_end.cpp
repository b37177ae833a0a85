#include "renderer/paint/terrain_end.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

constexpr float end_air = 0.86F;     // share of air at the end
constexpr double dissolving = 0.38;  // the last strip, as a share of the fade

constexpr double side_units = 150.0;    // over which the side of the terrain fades …
constexpr double side_of_sheet = 0.11;  // … but no more than this share of the sheet's width
constexpr double seen_units = 40.0;     // a cut so far outside the picture is not faded …
// Cosine of the angle between line of sight and edge from which a cut stands upright, and full.
constexpr double upright_from = 0.55;
constexpr double upright_full = 0.88;
constexpr float ragged = 0.11F;  // of the fade

// 1 at the edge of the terrain, 0 from `fade_m` inwards.
float rim_share(float rim_m, double fade_m) {
  return 1.0F - smoothstep(static_cast<float>(unit(rim_m / fade_m)));
}

}  // namespace

TerrainEnd terrain_end_at(float rim_m, double fade_m) {
  return {end_air * rim_share(rim_m, fade_m), rim_share(rim_m, dissolving * fade_m)};
}

float side_share(const TerrainSides& sides, const SidePlace& place) {
  const glm::dvec2 sight = place.position - sides.viewer;
  const double away = glm::length(sight);
  if (!(away > 0.0) || !(place.metres_per_unit > 0.0)) return 0.0F;
  const glm::dvec2 ahead = sight / away;
  const glm::dvec2 right(ahead.y, -ahead.x);
  double share = 0.0;
  for (const double side : {-1.0, 1.0}) {
    const glm::dvec2 aside = side * right;
    // The nearest edge on this side, and the cosine between it and the line of sight.
    double distance_m = std::numeric_limits<double>::infinity();
    double along = 0.0;
    for (const int axis : {0, 1}) {
      if (aside[axis] == 0.0) continue;
      const double edge = aside[axis] > 0.0 ? sides.high[axis] : sides.low[axis];
      const double way_m = std::max(0.0, (edge - place.position[axis]) / aside[axis]);
      if (way_m >= distance_m) continue;
      distance_m = way_m;
      along = std::abs(ahead[1 - axis]);
    }
    const double distance = distance_m / place.metres_per_unit;
    const double from_border = side < 0.0
                                   ? place.from_left_units - distance
                                   : place.sheet_width_units - place.from_left_units - distance;
    const double width_units = std::min(side_units, side_of_sheet * place.sheet_width_units) *
                               smoothstep(upright_from, upright_full, along) *
                               smoothstep(-seen_units, 0.0, from_border);
    if (width_units > 0.0) share = std::max(share, unit(1.0 - distance / width_units));
  }
  return static_cast<float>(share);
}

TerrainEnd with_sides(TerrainEnd end, float side, float noise) {
  if (side <= 0.0F) return end;
  const float in = 1.0F - side + ragged * std::clamp(noise, -1.5F, 1.5F) * side;
  return {std::max(end.air, end_air * (1.0F - smoothstep(0.15F, 1.0F, in))),
          std::max(end.dissolved, 1.0F - smoothstep(0.16F, 0.72F, in))};
}

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

float edge_mist_beside(float mist, float strength) {
  constexpr float thickest = 0.4F;  // of both together
  const float left = 1.0F - std::min(thickest * strength, 0.8F);
  return mist < 1.0F ? unit(1.0F - left / (1.0F - mist)) : 0.0F;
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
