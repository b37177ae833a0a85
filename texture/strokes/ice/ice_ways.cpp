#include "texture/strokes/ice/ice_ways.h"

#include <cmath>

#include "base/error.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {

const IcePlan& ice_of(const StrokeScene& scene) {
  if (scene.window.ice == nullptr)
    throw Error(ErrorKind::bug, "strokes", "ice is to be painted, but the scene has no ice plan");
  return *scene.window.ice;
}

glm::vec2 ice_direction(const StrokeScene& scene, glm::vec2 position) {
  return ice_of(scene).flow.at(position / scene.scale());
}

void lay_flow(Stroke& stroke, const StrokeScene& scene, glm::vec2 position, float length_px,
              float aside_rad) {
  const glm::vec2 turn = turn_by(aside_rad);
  const auto heading = [&](glm::vec2 at) { return turned(ice_direction(scene, at), turn); };
  const float step = length_px / 3.F;
  stroke.point_count = 4;
  // From the centre half a step in each direction, then a whole one with the heading at half the
  // distance.
  const glm::vec2 centre = heading(position);
  stroke.points[1] = position - centre * (0.5F * step);
  stroke.points[2] = position + centre * (0.5F * step);
  stroke.points[0] = stroke.points[1] - heading(stroke.points[1] - centre * (0.5F * step)) * step;
  stroke.points[3] = stroke.points[2] + heading(stroke.points[2] + centre * (0.5F * step)) * step;
}

Stroke ice_stroke(const StrokeScene& scene, std::size_t i, StrokeSeed& seed) {
  Stroke stroke = ground_stroke(scene, i, seed);
  stroke.gate = StrokeGate::same_class;
  stroke.depth_tolerance = same_ice_depth;
  lay_on_top(stroke);
  return stroke;
}

void lay_bow(Stroke& stroke, glm::vec2 centre, glm::vec2 across, glm::vec2 down, float length_px,
             float sag_px) {
  constexpr float positions[Stroke::max_points] = {-0.5F, -0.18F, 0.18F, 0.5F};
  stroke.point_count = Stroke::max_points;
  for (std::size_t k = 0; k < stroke.points.size(); ++k)
    stroke.points[k] = centre + across * (positions[k] * length_px) +
                       down * (sag_px * (1.F - 4.F * positions[k] * positions[k]));
}

StrokeSeed way_seed(const StrokeScene& scene, const IceWay& way, std::size_t part) {
  // Part 0 of the stream seeded the path itself.
  return {stream_seed(scene.parameters.seed, way.stream, part + 1), way.cell.x, way.cell.y};
}

std::optional<std::size_t> way_pixel(const StrokeScene& scene, const IceWay& way, std::size_t k) {
  const glm::vec2 position = way_place(scene, way, k);
  const PixelRect near = scene.seeded();
  const bool wanted =
      position.x >= static_cast<float>(near.x0) && position.y >= static_cast<float>(near.y0) &&
      position.x < static_cast<float>(near.x1) && position.y < static_cast<float>(near.y1);
  if (!wanted) return std::nullopt;
  const std::size_t here = scene.pixel(position);
  const bool other_surface =
      std::abs(scene.guidance.depth_m[here] / way.depth_m[k] - 1.F) > same_ice_depth;
  if (scene.class_at(here) != way.land_cover || other_surface) return std::nullopt;
  return here;
}

}  // namespace belvedere
