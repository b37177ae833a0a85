#include "texture/strokes/ice/ice_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "base/filter.h"
#include "base/parallel.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

constexpr float cell_units = 4.F;
constexpr double blur_cells = 2.0;

float cell_size_px(float pixels_per_unit) {
  return std::max(1.F, std::round(cell_units * pixels_per_unit));
}

glm::vec2 unit_or_down(glm::vec2 v) {
  const float length = glm::length(v);
  return length < 1e-6F ? glm::vec2(0.F, 1.F) : v / length;
}

}  // namespace

glm::vec2 IceFlow::at(glm::vec2 position_units) const {
  if (direction.empty()) return {0.F, 1.F};
  const glm::vec2 p = position_units / cell_units - 0.5F;
  const glm::vec2 base = glm::floor(p);
  const glm::vec2 t = p - base;
  const int x = static_cast<int>(base.x);
  const int y = static_cast<int>(base.y);
  const glm::vec2 top = direction.clamped(x, y) * (1.F - t.x) + direction.clamped(x + 1, y) * t.x;
  const glm::vec2 bottom =
      direction.clamped(x, y + 1) * (1.F - t.x) + direction.clamped(x + 1, y + 1) * t.x;
  return unit_or_down(top * (1.F - t.y) + bottom * t.y);
}

IceFlow find_ice_flow(const StrokeScene& scene) {
  const Grid<LandCoverClass>& land_cover = scene.guidance.land_cover;
  const auto cell = static_cast<int>(cell_size_px(scene.scale()));
  IceFlow flow;
  flow.cell_units = static_cast<float>(cell) / scene.scale();
  if (std::none_of(land_cover.begin(), land_cover.end(), is_ice)) return flow;
  Grid<float> x_sum((land_cover.width() + cell - 1) / cell, (land_cover.height() + cell - 1) / cell,
                    0.F);
  Grid<float> y_sum(x_sum.width(), x_sum.height(), 0.F);
  parallel_rows(x_sum.height(), [&](int cy) {
    for (int y = cy * cell; y < std::min(land_cover.height(), (cy + 1) * cell); ++y)
      for (int x = 0; x < land_cover.width(); ++x) {
        if (!is_ice(land_cover(x, y))) continue;
        const glm::vec2 fall = scene.guidance.fall_line(x, y);
        x_sum(x / cell, cy) += fall.x;
        y_sum(x / cell, cy) += fall.y;
      }
  });
  x_sum = gaussian_blur(x_sum, blur_cells);
  y_sum = gaussian_blur(y_sum, blur_cells);
  flow.direction = Grid<glm::vec2>(x_sum.width(), x_sum.height());
  for (std::size_t i = 0; i < x_sum.size(); ++i) flow.direction[i] = {x_sum[i], y_sum[i]};
  return flow;
}

std::vector<glm::vec2> trace_ice(const StrokeScene& scene, const IceFlow& flow, glm::vec2 position,
                                 float step_px, int steps) {
  std::vector<glm::vec2> way{position};
  const std::size_t first = scene.pixel(position);
  float depth = scene.guidance.depth_m[first];
  for (int k = 0; k < steps; ++k) {
    const glm::vec2 half = position + flow.at(position / scene.scale()) * (0.5F * step_px);
    position += flow.at(half / scene.scale()) * step_px;
    if (!scene.on_canvas(position)) break;
    const std::size_t here = scene.pixel(position);
    if (scene.class_at(here) != scene.class_at(first) ||
        std::abs(scene.guidance.depth_m[here] / depth - 1.F) > same_ice_depth)
      break;
    depth = scene.guidance.depth_m[here];
    way.push_back(position);
  }
  return way;
}

bool same_ice_surface(const StrokeScene& scene, std::size_t a, std::size_t b) {
  return std::abs(scene.guidance.depth_m[a] / scene.guidance.depth_m[b] - 1.F) < same_ice_depth;
}

IceWay way_along(const StrokeScene& scene, Stream stream, const StrokeSeed& seed,
                 const std::vector<glm::vec2>& positions) {
  IceWay way{.stream = stream,
             .cell = seed.cell(),
             .land_cover = scene.class_at(scene.pixel(positions.front()))};
  way.positions.reserve(positions.size());
  way.depth_m.reserve(positions.size());
  way.lowest = way.highest = positions.front() / scene.scale();
  for (const glm::vec2 position : positions) {
    way.positions.push_back(position / scene.scale());
    way.depth_m.push_back(scene.guidance.depth_m[scene.pixel(position)]);
    way.lowest = glm::min(way.lowest, way.positions.back());
    way.highest = glm::max(way.highest, way.positions.back());
  }
  return way;
}

float on_tongue(const StrokeScene& scene, glm::vec2 position) {
  const auto has_none = [&](std::size_t k) {
    return !scene.guidance.is_sky(k) && !is_ice(scene.class_at(k));
  };
  const float near = share_around(scene, position, 11.F, has_none);
  const float far = share_around(scene, position, 26.F, has_none);
  return std::clamp((near + far - 0.1F) / 0.35F, 0.F, 1.F);
}

glm::vec2 across_flow(const StrokeScene& scene, glm::vec2 position, glm::vec2 flow) {
  constexpr float step_units = 3.F;
  constexpr float shortest = 0.28F;
  constexpr float longest = 1.1F;
  const glm::vec2 plain{-flow.y, flow.x};
  const auto& g = scene.guidance;
  const std::size_t i = scene.pixel(position);
  // Ground in plan for a unit of the sheet in a direction, m.
  const auto ground = [&](glm::vec2 way) -> std::optional<glm::vec2> {
    const glm::vec2 there = position + way * (step_units * scene.scale());
    const glm::vec2 here = position - way * (step_units * scene.scale());
    if (!scene.on_canvas(there) || !scene.on_canvas(here)) return std::nullopt;
    const std::size_t a = scene.pixel(here);
    const std::size_t b = scene.pixel(there);
    if (g.is_sky(a) || g.is_sky(b) || !same_ice_surface(scene, a, i) ||
        !same_ice_surface(scene, b, i))
      return std::nullopt;
    const glm::vec3 offset = g.position_m[b] - g.position_m[a];
    return glm::vec2(offset) / (2.F * step_units);
  };
  const auto right = ground({1.F, 0.F});
  const auto down = ground({0.F, 1.F});
  if (!right || !down) return 0.6F * plain;
  const float area = right->x * down->y - right->y * down->x;
  const glm::vec2 along = *right * flow.x + *down * flow.y;
  const float length = glm::length(along);
  if (std::abs(area) < 1e-4F * glm::dot(*right, *right) || length < 1e-4F) return 0.6F * plain;
  // Perpendicular to the flow on the ground, as long as a unit of the sheet shows.
  const glm::vec2 aside = glm::vec2(-along.y, along.x) * (scene.metres_per_unit(i) / length);
  glm::vec2 seen{(aside.x * down->y - aside.y * down->x) / area,
                 (right->x * aside.y - right->y * aside.x) / area};
  if (glm::dot(seen, plain) < 0.F) seen = -seen;
  const float size = glm::length(seen);
  if (!(size > 1e-4F)) return 0.6F * plain;
  return seen * (std::clamp(size, shortest, longest) / size);
}

float ice_slope_deg(const StrokeScene& scene, const IceFlow& flow, glm::vec2 position) {
  const glm::vec2 down = flow.at(position / scene.scale()) * scene.scale();
  const glm::vec2 aside{-down.y, down.x};
  const std::size_t i = scene.pixel(position);
  float sum = 0.F;
  int count = 0;
  for (const glm::vec2 offset :
       {glm::vec2(0.F), 2.F * down, -2.F * down, 2.F * aside, -2.F * aside}) {
    if (!scene.on_canvas(position + offset)) continue;
    const std::size_t k = scene.pixel(position + offset);
    if (!is_ice(scene.class_at(k)) || !same_ice_surface(scene, k, i)) continue;
    sum += scene.slope_deg(k);
    ++count;
  }
  return count > 0 ? sum / static_cast<float>(count) : scene.slope_deg(i);
}

}  // namespace belvedere
