#include "texture/strokes/stroke_seeds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/math_exact.h"

namespace belvedere {

glm::vec2 StrokeScene::fall_line(glm::vec2 place) const {
  const glm::vec2 direction = guidance.fall_line.clamped(static_cast<int>(place.x), static_cast<int>(place.y));
  const float length = glm::length(direction);
  return length < 1e-3F ? glm::vec2(0.F, 1.F) : direction / length;
}

glm::vec3 StrokeScene::colour(std::size_t i, float m, float jitter, StrokeSeed& seed) const {
  const glm::vec3 here = base.colour[i];
  const glm::vec3 there = m < 0.F ? base.darker[i] : base.lighter[i];
  const float value = seed.normal() * jitter;
  const float warmth = seed.normal() * jitter * 0.6F;
  return here + (there - here) * std::min(1.5F, std::abs(m)) + glm::vec3(value + warmth, value, value - warmth);
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

void lay_line(Stroke& stroke, const StrokeScene& scene, glm::vec2 place, float length_units, float angle_rad, float wobble_rad, bool follow,
              StrokeSeed& seed) {
  const float length_px = length_units * scene.scale();
  const glm::vec2 turn = turn_by(angle_rad);
  glm::vec2 heading = follow ? turned(scene.fall_line(place), turn) : turn;
  float bend = seed.normal() * wobble_rad;
  glm::vec2 point = place - heading * (length_px * 0.5F);
  stroke.point_count = Stroke::max_points;
  for (auto& vertex : stroke.points) {
    vertex = point;
    if (follow) {
      // Ease towards the local fall line, on the side the stroke already runs.
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
