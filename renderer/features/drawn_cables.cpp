#include "renderer/features/drawn_cables.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace belvedere {
namespace {

constexpr double sag_share = 0.06;     // max sag of the rope below the taut line, relative to its
                                       // length: so far it follows the ground
constexpr double highest_pylon = 2.2;  // in usual heights: over gorges ropes hang free
constexpr int min_steps = 24;
constexpr int max_steps = 400;
constexpr float station_mm = 0.75;  // side, in the foreground

struct RopePoint {
  glm::dvec2 map{0.0};
  glm::dvec3 ground{0.0};
  glm::dvec3 rope{0.0};
  double along_m = 0.0;
  glm::dvec2 foot_px{0.0};
  glm::dvec2 rope_px{0.0};
  double distance_m = 0.0;
  double hidden_by_m = 0.0;
  bool in_picture = false;
  bool seen = false;
  bool free = false;  // too high for a pylon
  PointLook look;
};

// Heights of a taut rope over positions: the upper hull of their heights along the line.
void tighten(const std::vector<RopePoint>& points, std::vector<double>& heights) {
  std::vector<std::size_t> hull;
  for (std::size_t i = 0; i < points.size(); ++i) {
    while (hull.size() > 1) {
      const std::size_t a = hull[hull.size() - 2];
      const std::size_t b = hull.back();
      const double over_a = (heights[i] - heights[a]) * (points[b].along_m - points[a].along_m);
      if (heights[b] - heights[a] > over_a / std::max(1e-9, points[i].along_m - points[a].along_m))
        break;
      hull.pop_back();
    }
    hull.push_back(i);
  }
  std::vector<double> tight = heights;
  for (std::size_t k = 0; k + 1 < hull.size(); ++k)
    for (std::size_t i = hull[k]; i <= hull[k + 1]; ++i) {
      const double t = (points[i].along_m - points[hull[k]].along_m) /
                       std::max(1e-9, points[hull[k + 1]].along_m - points[hull[k]].along_m);
      tight[i] = heights[hull[k]] + t * (heights[hull[k + 1]] - heights[hull[k]]);
    }
  heights = std::move(tight);
}

// Points along one straight section of the lift; empty if it leaves the terrain.
std::vector<RopePoint> hang_rope(const CableMaking& making, const Feature& feature, glm::dvec2 from,
                                 glm::dvec2 to) {
  const FeatureKind& kind = making.kind;
  const double length_m = glm::length(to - from);
  const int steps = std::clamp(static_cast<int>(std::ceil(length_m / making.sight.cell_m())),
                               min_steps, max_steps);
  std::vector<RopePoint> points;
  std::vector<double> heights;
  for (int i = 0; i <= steps; ++i) {
    RopePoint point;
    const double t = static_cast<double>(i) / steps;
    point.map = glm::mix(from, to, t);
    point.along_m = t * length_m;
    const auto ground = making.sight.ground(point.map);
    if (!ground) return {};
    point.ground = *ground;
    const auto pixel = making.sight.pixel(point.ground);
    if (!pixel) return {};
    point.foot_px = *pixel;
    point.look = look_at(making.sight, point.ground, point.foot_px, kind, feature.width_mm,
                         feature.real_m, making.px_per_mm, making.foreground_m_per_px);
    // High enough to be visible: at true scale the rope would appear to lie on the ground from a
    // few kilometres.
    const double shown_m = kind.height_mm * point.look.share * making.px_per_mm *
                           making.sight.metres_per_px(point.ground, point.foot_px);
    heights.push_back(point.ground.z + std::max(kind.height_m, shown_m));
    points.push_back(point);
  }
  const std::vector<double> lowest = heights;
  tighten(points, heights);
  const glm::dvec2 size = making.sight.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    RopePoint& point = points[i];
    point.rope = {point.ground.x, point.ground.y,
                  std::max(lowest[i], heights[i] - sag_share * length_m)};
    point.free = point.rope.z - point.ground.z > highest_pylon * (lowest[i] - point.ground.z);
    const auto pixel = making.sight.pixel(point.rope);
    if (!pixel) return {};
    point.rope_px = *pixel;
    point.distance_m = making.sight.distance_m(point.rope, point.rope_px);
    point.in_picture = pixel->x > -0.1 * size.x && pixel->y > -0.1 * size.y &&
                       pixel->x < 1.1 * size.x && pixel->y < 1.1 * size.y;
  }
  std::vector<GroundSight::Target> targets;
  for (const RopePoint& point : points)
    targets.push_back({point.rope, point.rope_px, point.distance_m});
  const std::vector<double> hidden = making.sight.hidden_by_m(targets);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].hidden_by_m = hidden[i];
    points[i].seen = points[i].in_picture && hidden[i] == 0.0;
  }
  return points;
}

DrawnPoint to_drawn(const RopePoint& point, glm::dvec2 position, float half_px, double along_mm) {
  return {.position = glm::vec2(position),
          .distance_m = static_cast<float>(point.distance_m),
          .half_px = half_px,
          .share = static_cast<float>(point.look.share),
          .along_mm = static_cast<float>(along_mm)};
}

// The ground below a rope where trees would reach it.
void add_lanes(const CableMaking& making, int kind, const std::vector<RopePoint>& points,
               std::vector<DrawnLine>& lines) {
  if (making.kind.clear_mm <= 0.0) return;
  DrawnLine lane{.kind = kind, .part = LinePart::lane, .points = {}};
  for (std::size_t i = 0; i <= points.size(); ++i) {
    if (i < points.size() && points[i].in_picture && !points[i].free) {
      lane.points.push_back(
          to_drawn(points[i], points[i].foot_px, static_cast<float>(points[i].look.half_px), 0.0));
      lane.points.back().distance_m =
          static_cast<float>(making.sight.distance_m(points[i].ground, points[i].foot_px));
      continue;
    }
    if (lane.points.size() > 1) lines.push_back(lane);
    lane.points.clear();
  }
}

}  // namespace

void draw_cable(const CableMaking& making, const Feature& feature, std::vector<DrawnLine>& lines,
                DrawnCount& count) {
  const FeatureKind& kind = making.kind;
  const std::vector<glm::dvec2>& stations = feature.parts.front();
  const std::size_t before = lines.size();
  bool on_terrain = false;
  bool in_picture = false;
  bool far = false;
  for (std::size_t s = 0; s + 1 < stations.size(); ++s) {
    const std::vector<RopePoint> points = hang_rope(making, feature, stations[s], stations[s + 1]);
    if (points.empty()) continue;
    on_terrain = true;
    count.length_m += points.back().along_m;
    DrawnLine rope{.kind = feature.kind, .part = LinePart::rope, .points = {}};
    const auto end_rope = [&] {
      if (rope.points.size() > 1) lines.push_back(rope);
      rope.points.clear();
    };
    double along_mm = 0.0;
    double next_pylon_mm = kind.pylon_mm;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const RopePoint& point = points[i];
      in_picture = in_picture || point.in_picture;
      if (i > 0) {
        along_mm += glm::length(point.rope_px - points[i - 1].rope_px) /
                    (making.px_per_mm * point.look.share);
        if (point.seen && points[i - 1].seen) count.seen_m += point.along_m - points[i - 1].along_m;
      }
      far = far || (point.seen && point.look.too_far);
      if (!point.seen || point.look.too_far) {
        end_rope();
        continue;
      }
      rope.points.push_back(
          to_drawn(point, point.rope_px, static_cast<float>(point.look.half_px), along_mm));
      const bool end = i == 0 || i + 1 == points.size();
      const auto half = static_cast<float>(point.look.half_px);
      if (end) {
        const float side = static_cast<float>(station_mm * making.px_per_mm * point.look.share);
        lines.push_back({.kind = feature.kind,
                         .part = LinePart::station,
                         .points = {to_drawn(point, point.foot_px, 0.5F * side, 0.0),
                                    to_drawn(point, point.foot_px + glm::dvec2(0.0, -0.9 * side),
                                             0.5F * side, 0.0)}});
      } else if (kind.pylon_mm > 0.0 && !point.free && along_mm >= next_pylon_mm) {
        next_pylon_mm = along_mm + kind.pylon_mm;
        lines.push_back({.kind = feature.kind,
                         .part = LinePart::pylon,
                         .points = {to_drawn(point, point.foot_px, 1.15F * half, 0.0),
                                    to_drawn(point, point.rope_px, 0.9F * half, 0.0)}});
      }
    }
    end_rope();
    if (lines.size() > before) add_lanes(making, feature.kind, points, lines);
  }
  ++count.features;
  ++(!on_terrain             ? count.outside_terrain
     : !in_picture           ? count.outside_picture
     : lines.size() > before ? count.drawn
     : far                   ? count.too_far
                             : count.hidden);
}

}  // namespace belvedere
