#include "texture/strokes/ice/ice_flow.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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

}  // namespace belvedere
