#include "texture/strokes/ice/ice_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "texture/strokes/stroke_parts.h"

namespace belvedere {

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
