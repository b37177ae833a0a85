#include "texture/strokes/ice_flow.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/filter.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

constexpr float cell_units = 4.F;
constexpr double blur_cells = 2.0;
constexpr float same_surface = 0.03F;  // relative depth

float cell_size_px(float pixels_per_unit) { return std::max(1.F, std::round(cell_units * pixels_per_unit)); }

glm::vec2 unit_or_down(glm::vec2 v) {
  const float length = glm::length(v);
  return length < 1e-6F ? glm::vec2(0.F, 1.F) : v / length;
}

}  // namespace

glm::vec2 IceFlow::at(glm::vec2 place) const {
  const glm::vec2 p = place / cell_px - 0.5F;
  const glm::vec2 base = glm::floor(p);
  const glm::vec2 t = p - base;
  const int x = static_cast<int>(base.x) - first_cell.x;
  const int y = static_cast<int>(base.y) - first_cell.y;
  const glm::vec2 top = direction.clamped(x, y) * (1.F - t.x) + direction.clamped(x + 1, y) * t.x;
  const glm::vec2 bottom = direction.clamped(x, y + 1) * (1.F - t.x) + direction.clamped(x + 1, y + 1) * t.x;
  return unit_or_down(top * (1.F - t.y) + bottom * t.y);
}

IceFlow find_ice_flow(const StrokeScene& scene) {
  IceFlow flow;
  flow.cell_px = cell_size_px(scene.scale());
  const auto cell = static_cast<int>(flow.cell_px);
  const glm::ivec2 origin = scene.window.origin_px;
  const glm::ivec2 end = origin + glm::ivec2(scene.guidance.width(), scene.guidance.height());
  flow.first_cell = origin / cell;
  const int width = (end.x + cell - 1) / cell - flow.first_cell.x;
  const int height = (end.y + cell - 1) / cell - flow.first_cell.y;
  Grid<float> x_sum(width, height, 0.F);
  Grid<float> y_sum(width, height, 0.F);
  parallel_rows(height, [&](int cy) {
    const int top = (flow.first_cell.y + cy) * cell;
    for (int y = std::max(origin.y, top); y < std::min(end.y, top + cell); ++y)
      for (int x = origin.x; x < end.x; ++x) {
        if (!is_ice(scene.guidance.land_cover(x - origin.x, y - origin.y))) continue;
        const glm::vec2 fall = scene.guidance.fall_line(x - origin.x, y - origin.y);
        const int cx = x / cell - flow.first_cell.x;
        x_sum(cx, cy) += fall.x;
        y_sum(cx, cy) += fall.y;
      }
  });
  x_sum = gaussian_blur(x_sum, blur_cells);
  y_sum = gaussian_blur(y_sum, blur_cells);
  flow.direction = Grid<glm::vec2>(width, height);
  for (std::size_t i = 0; i < x_sum.size(); ++i) flow.direction[i] = {x_sum[i], y_sum[i]};
  return flow;
}

// A place lies between cells up to 1.5 of them away, and each gathers from as far as the kernel goes, 4 sigma.
double ice_flow_reach_px(double pixels_per_unit) {
  return (1.5 + 4.0 * blur_cells) * static_cast<double>(cell_size_px(static_cast<float>(pixels_per_unit)));
}

void lay_flow(Stroke& stroke, const IceFlow& flow, glm::vec2 place, float length_px, float aside_rad) {
  const glm::vec2 turn = turn_by(aside_rad);
  const auto heading = [&](glm::vec2 at) {
    const glm::vec2 v = flow.at(at);
    return turned(v, turn);
  };
  const float step = length_px / 3.F;
  stroke.point_count = 4;
  // From the middle half a step each way, then a whole one with the heading halfway there.
  const glm::vec2 middle = heading(place);
  stroke.points[1] = place - middle * (0.5F * step);
  stroke.points[2] = place + middle * (0.5F * step);
  stroke.points[0] = stroke.points[1] - heading(stroke.points[1] - middle * (0.5F * step)) * step;
  stroke.points[3] = stroke.points[2] + heading(stroke.points[2] + middle * (0.5F * step)) * step;
}

std::vector<glm::vec2> trace_ice(const StrokeScene& scene, const IceFlow& flow, glm::vec2 place, float step_px, int steps) {
  std::vector<glm::vec2> way{place};
  const std::size_t first = scene.pixel(place);
  float depth = scene.guidance.depth_m[first];
  for (int k = 0; k < steps; ++k) {
    const glm::vec2 half = place + flow.at(place) * (0.5F * step_px);
    place += flow.at(half) * step_px;
    if (!scene.on_canvas(place)) break;
    const std::size_t here = scene.pixel(place);
    if (scene.class_at(here) != scene.class_at(first) || std::abs(scene.guidance.depth_m[here] / depth - 1.F) > same_surface) break;
    depth = scene.guidance.depth_m[here];
    way.push_back(place);
  }
  return way;
}

}  // namespace belvedere
