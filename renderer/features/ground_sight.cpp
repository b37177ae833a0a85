#include "renderer/features/ground_sight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "base/statistics.h"
#include "renderer/trace/facet_hit.h"
#include "terrain/generalize/moved_ground.h"

namespace belvedere {
namespace {

bool holds(const PixelRect& posts, glm::dvec2 at) {
  return at.x >= posts.x0 && at.y >= posts.y0 && at.x <= posts.x1 - 1 && at.y <= posts.y1 - 1;
}

}  // namespace

GroundSight::GroundSight(const GeoTransform& transform, const DeformedSurface& surface,
                         const Camera& camera, const Tracer& tracer, const Grid<glm::vec2>& goes_to)
    : transform_(transform),
      surface_(surface),
      camera_(camera),
      tracer_(tracer),
      goes_to_(goes_to),
      cell_m_(0.5 * (transform.cell_x + transform.cell_y) /
              std::ldexp(1.0, static_cast<int>(surface.windows.size()))) {}

std::optional<glm::dvec3> GroundSight::ground(glm::dvec2 position) const {
  glm::dvec2 at = drawn_cell(goes_to_, transform_.to_cell(position.x, position.y));
  if (!holds({0, 0, surface_.vertices_m.width(), surface_.vertices_m.height()}, at))
    return std::nullopt;
  const DeformedSurface* finest = &surface_;
  for (const SurfaceWindow& window : surface_.windows) {
    if (!holds(window.replaces, at)) break;
    // Post (x, y) of a part is at post (x / 2, y / 2) of the surface before it.
    at = glm::dvec2(window.part.x0, window.part.y0) +
         2.0 * (at - glm::dvec2(window.replaces.x0, window.replaces.y0));
    finest = &window.surface;
  }
  return finest->origin + on_facet(finest->vertices_m, at);
}

double GroundSight::distance_m(glm::dvec3 point, glm::dvec2 pixel) const {
  const Ray ray = camera_.ray(pixel);
  return glm::dot(point - ray.origin, ray.direction);
}

double GroundSight::metres_per_px(glm::dvec3 point, glm::dvec2 pixel) const {
  // Across the line of sight, horizontal.
  const glm::dvec3 sight = camera_.ray(pixel).direction;
  glm::dvec3 across{sight.y, -sight.x, 0.0};
  const double level = glm::length(across);
  across = level > 1e-6 ? across / level : glm::dvec3(1.0, 0.0, 0.0);
  const double step_m = 1e-3 * std::max(1.0, distance_m(point, pixel));
  const auto beside = camera_.project(point + across * step_m);
  const double px = beside ? glm::length(*beside - pixel) : 0.0;
  return px > 1e-9 ? step_m / px : 1e9;
}

std::vector<double> GroundSight::hidden_by_m(const std::vector<Target>& targets) const {
  std::vector<Ray> rays;
  rays.reserve(targets.size());
  for (const Target& target : targets) rays.push_back(camera_.ray(target.pixel));
  std::vector<Hit> hits(targets.size());
  tracer_.intersect(rays, hits);
  std::vector<double> hidden(targets.size(), 0.0);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    // By rounding, a ground point may appear in front of itself.
    const double rounding_m = 0.1 + 1e-6 * targets[i].distance_m;
    if (hits[i].found && hits[i].distance_m < targets[i].distance_m - rounding_m)
      hidden[i] = targets[i].distance_m - hits[i].distance_m;
  }
  return hidden;
}

double GroundSight::nearest_metres_per_px() const {
  constexpr int columns = 15;
  const glm::ivec2 size = camera_.size();
  // From the lower edge upwards, until half of a row is ground.
  for (int step = 0; step < 16; ++step) {
    const double y = size.y - 0.5 - step * size.y / 16.0;
    std::vector<double> found;
    for (int k = 0; k < columns; ++k) {
      const glm::dvec2 pixel{(k + 0.5) * size.x / columns, y};
      const Ray ray = camera_.ray(pixel);
      Hit hit;
      tracer_.intersect(std::span(&ray, 1), std::span(&hit, 1));
      if (hit.found)
        found.push_back(metres_per_px(ray.origin + ray.direction * hit.distance_m, pixel));
    }
    if (2 * found.size() < columns) continue;
    return middle_value(std::move(found));
  }
  return 1.0;
}

}  // namespace belvedere
