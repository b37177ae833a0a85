#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "base/guidance_buffers.h"
#include "texture/strokes/brush.h"
#include "texture/strokes/ice/ice_plan.h"
#include "texture/strokes/stroke_painter.h"
#include "texture/strokes/stroke_seeds.h"
#include "texture/strokes/stroke_table.h"

namespace belvedere {

// The input of tests of strokes.
struct Picture {
  GuidanceBuffers guidance;
  BasePicture ground;
  StrokeParameters parameters;
  StrokeScene scene() const { return {guidance, ground, parameters}; }
};

// One class everywhere, a slope of 25° straight down, tone .6, three greys to mix from, clear air,
// trees where trees grow. Depth and positions are zero: each test sets its own ground.
inline Picture plain_picture(LandCoverClass id, int width, int height) {
  Picture p;
  p.guidance.depth_m = Grid<float>(width, height, 0.F);
  p.guidance.land_cover = Grid<LandCoverClass>(width, height, id);
  p.guidance.fall_line = Grid<glm::vec2>(width, height, glm::vec2(0.F, 1.F));
  p.guidance.tone = Grid<float>(width, height, 0.6F);
  p.guidance.position_m = Grid<glm::vec3>(width, height);
  p.guidance.slope_deg = Grid<float>(width, height, 25.F);
  p.guidance.footprint_m = Grid<float>(width, height, 30.F);
  p.guidance.relief_s_m = p.guidance.built = Grid<float>(width, height, 0.F);
  p.guidance.grain = Grid<glm::vec2>(width, height);
  p.ground.colour = Grid<glm::vec3>(width, height, glm::vec3(0.5F));
  p.ground.darker = Grid<glm::vec3>(width, height, glm::vec3(0.4F));
  p.ground.lighter = Grid<glm::vec3>(width, height, glm::vec3(0.6F));
  p.ground.accent = Grid<float>(width, height, 0.F);
  p.ground.tree_density = Grid<float>(width, height, 0.95F);
  p.ground.haze = Grid<float>(width, height, 0.F);
  return p;
}

inline float luma(glm::vec3 c) { return 0.2126F * c.x + 0.7152F * c.y + 0.0722F * c.z; }

inline const StrokeKind& find_stroke_kind(std::string_view name) {
  for (const StrokeKind& kind : stroke_kinds())
    if (kind.name == name) return kind;
  throw std::out_of_range("no kind of stroke has this name");
}

// The strokes of one kind alone on a whole sheet.
inline std::vector<Stroke> grow_strokes(std::string_view name, const StrokeScene& scene) {
  const StrokeKind& kind = find_stroke_kind(name);
  if (!kind.on_ice) return kind.grow(scene, kind.stream);
  const IcePlan plan = plan_ice(scene.guidance, scene.parameters);
  StrokeScene planned = scene;
  planned.window.ice = &plan;
  return kind.grow(planned, kind.stream);
}

inline std::vector<Stroke> grow_all(const std::vector<std::string_view>& names,
                                    const StrokeScene& scene) {
  std::vector<Stroke> all;
  for (const std::string_view name : names) {
    const std::vector<Stroke> more = grow_strokes(name, scene);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

// A forest with its edges and glades; a town with its churches.
inline std::vector<Stroke> wood_strokes(const StrokeScene& scene) {
  return grow_all({"forest trees", "forest edges", "glade grass"}, scene);
}
inline std::vector<Stroke> town_strokes(const StrokeScene& scene) {
  return grow_all({"houses", "churches"}, scene);
}

// Calls `look` with the picture painted from several seeds, for properties that hold on average.
inline constexpr std::uint64_t test_seeds = 12;
template <class Look>
void over_seeds(Picture& p, Look&& look) {
  for (p.parameters.seed = 1; p.parameters.seed <= test_seeds; ++p.parameters.seed) look();
  p.parameters.seed = 1;
}

// From a stroke's first point to its last, px.
inline glm::vec2 axis_of(const Stroke& s) {
  return s.points[static_cast<std::size_t>(s.point_count - 1)] - s.points[0];
}

// Between an axis (without sense) and a direction, 0…90.
inline double angle_deg(glm::vec2 axis, glm::vec2 direction) {
  const double c = std::abs(glm::dot(glm::normalize(axis), glm::normalize(direction)));
  return std::acos(std::min(1.0, c)) * 57.29578;
}

}  // namespace belvedere
