#include "texture/strokes/stroke_seeds.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/math_exact.h"

namespace belvedere {

PixelRect StrokeScene::seeded() const {
  const glm::ivec2 origin = window.origin_px;
  const PixelRect held{origin.x, origin.y, origin.x + guidance.width(),
                       origin.y + guidance.height()};
  if (seed_reach_px < 0 || window.asked == PixelRect{}) return held;
  return {std::max(held.x0, origin.x + window.asked.x0 - seed_reach_px),
          std::max(held.y0, origin.y + window.asked.y0 - seed_reach_px),
          std::min(held.x1, origin.x + window.asked.x1 + seed_reach_px),
          std::min(held.y1, origin.y + window.asked.y1 + seed_reach_px)};
}

SeededCells StrokeScene::seeded_cells(float spacing_px, bool with_cut) const {
  const auto along = [&](int first_px, int end_px, int sheet) {
    const auto cell = [&](int px) { return static_cast<int>(static_cast<float>(px) / spacing_px); };
    return CellRange{std::max(0, cell(first_px) - 1),
                     std::min(cell(sheet) - (with_cut ? 0 : 1), cell(end_px) + 1)};
  };
  const PixelRect rect = seeded();
  return {along(rect.x0, rect.x1, sheet_px().x), along(rect.y0, rect.y1, sheet_px().y)};
}

std::uint64_t StrokeScene::sheet_index(std::size_t i) const {
  const auto width = static_cast<std::size_t>(guidance.width());
  const std::uint64_t x = i % width + static_cast<std::uint64_t>(window.origin_px.x);
  const std::uint64_t y = i / width + static_cast<std::uint64_t>(window.origin_px.y);
  return y * static_cast<std::uint64_t>(sheet_px().x) + x;
}

glm::vec2 StrokeScene::fall_line(glm::vec2 position) const {
  const glm::vec2 direction =
      guidance.fall_line.clamped(static_cast<int>(position.x) - window.origin_px.x,
                                 static_cast<int>(position.y) - window.origin_px.y);
  const float length = glm::length(direction);
  return length < 1e-3F ? glm::vec2(0.F, 1.F) : direction / length;
}

glm::vec3 StrokeScene::colour(std::size_t i, float m, float jitter, StrokeSeed& seed) const {
  const glm::vec3 here = base.colour[i];
  const glm::vec3 there = m < 0.F ? base.darker[i] : base.lighter[i];
  // Ground that has dissolved in air has no paint of its own.
  jitter *= 1.F - smoothstep(0.90F, 0.99F, base.haze[i]);
  const float value = seed.normal() * jitter;
  const float warmth = seed.normal() * jitter * 0.6F;
  return here + (there - here) * std::min(1.5F, std::abs(m)) +
         glm::vec3(value + warmth, value, value - warmth);
}

glm::vec2 turn_by(float angle_rad) {
  const exact::Turn turn = exact::turn(static_cast<double>(angle_rad));
  return {static_cast<float>(turn.cosine), static_cast<float>(turn.sine)};
}

float mixed_tone(float dark, float light, StrokeSeed& seed) {
  const float u = seed.uniform();
  if (u < dark) return -0.5F - 0.6F * seed.uniform();
  if (u > 1.F - light) return 0.4F + 0.6F * seed.uniform();
  return 0.25F * seed.normal();
}

void lay_line(Stroke& stroke, const StrokeScene& scene, glm::vec2 position, float length_units,
              float angle_rad, float wobble_rad, bool follow, StrokeSeed& seed) {
  const float length_px = length_units * scene.scale();
  const glm::vec2 turn = turn_by(angle_rad);
  glm::vec2 heading = follow ? turned(scene.fall_line(position), turn) : turn;
  float bend = seed.normal() * wobble_rad;
  glm::vec2 point = position - heading * (length_px * 0.5F);
  stroke.point_count = Stroke::max_points;
  for (auto& vertex : stroke.points) {
    vertex = point;
    if (follow) {
      // Turns gradually towards the local fall line, in the sense in which the stroke already runs.
      glm::vec2 local = turned(scene.fall_line(point), turn);
      if (glm::dot(local, heading) < 0.F) local = -local;
      heading = 0.6F * heading + 0.4F * local;
      heading /= glm::length(heading) + 1e-6F;
    }
    point += turned(heading, turn_by(bend)) * (length_px / 3.F);
    bend *= 0.6F;
  }
}

}  // namespace belvedere
