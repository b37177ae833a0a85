#include "renderer/trace/geo_map.h"

#include <glm/geometric.hpp>
#include <span>

#include "base/filter.h"
#include "renderer/trace/traced_part.h"
#include "terrain/generalize/widen_valleys.h"

namespace belvedere {

GeoMap::GeoMap(const Grid<float>& altitude_m, const Grid<glm::vec2>& goes_to,
               const GeoTransform& transform, const Deformation& deformation,
               const DeformedSurface& surface, const Camera& camera, const Tracer& tracer)
    : altitude_m_(altitude_m),
      goes_to_(goes_to),
      transform_(transform),
      deformation_(deformation),
      surface_(surface),
      camera_(camera),
      tracer_(tracer) {}

glm::dvec2 GeoMap::drawn_position(glm::dvec2 position) const {
  if (goes_to_.empty()) return position;
  const glm::dvec2 drawn = drawn_cell(goes_to_, transform_.to_cell(position.x, position.y));
  return transform_.to_crs(drawn.x, drawn.y);
}

glm::dvec2 GeoMap::position_of_drawn(glm::dvec2 drawn) const {
  if (goes_to_.empty()) return drawn;
  const glm::dvec2 origin = origin_cell(goes_to_, transform_.to_cell(drawn.x, drawn.y));
  return transform_.to_crs(origin.x, origin.y);
}

std::optional<glm::dvec3> GeoMap::on_surface(glm::dvec2 position) const {
  return drawn_surface(drawn_position(position));
}

std::optional<glm::dvec3> GeoMap::drawn_surface(glm::dvec2 drawn) const {
  const Grid<glm::vec3>& posts = surface_.vertices_m;
  const glm::dvec2 at = transform_.to_cell(drawn.x, drawn.y);
  if (!(at.x >= 0.0 && at.y >= 0.0 && at.x <= posts.width() - 1.0 && at.y <= posts.height() - 1.0))
    return std::nullopt;
  return surface_.origin + on_facet(posts, at);
}

std::optional<ImagePosition> GeoMap::see(glm::dvec3 deformed) const {
  const auto pixel = camera_.project(deformed);
  if (!pixel) return std::nullopt;
  ImagePosition out;
  out.pixel = *pixel;
  out.deformed = deformed;
  const Ray ray = camera_.ray(*pixel);
  out.distance_m = glm::dot(deformed - ray.origin, ray.direction);
  out.in_picture = pixel->x >= 0.0 && pixel->y >= 0.0 && pixel->x <= camera_.size().x &&
                   pixel->y <= camera_.size().y;
  if (!out.in_picture) return out;
  Hit hit;
  tracer_.intersect(std::span(&ray, 1), std::span(&hit, 1));
  // By rounding, a ground point may appear in front of itself.
  const double rounding_m = 0.1 + 1e-6 * out.distance_m;
  out.visible = !hit.found || hit.distance_m >= out.distance_m - rounding_m;
  return out;
}

std::optional<ImagePosition> GeoMap::to_image(glm::dvec2 position) const {
  return drawn_to_image(drawn_position(position));
}

std::optional<ImagePosition> GeoMap::drawn_to_image(glm::dvec2 drawn) const {
  const auto deformed = drawn_surface(drawn);
  return deformed ? see(*deformed) : std::nullopt;
}

std::optional<ImagePosition> GeoMap::to_image(glm::dvec3 position) const {
  return see(deformation_.point({drawn_position({position.x, position.y}), position.z}));
}

std::optional<GeoPosition> GeoMap::to_geo(glm::dvec2 pixel) const {
  const Ray ray = camera_.ray(pixel);
  Hit hit;
  tracer_.intersect(std::span(&ray, 1), std::span(&hit, 1));
  if (!hit.found) return std::nullopt;
  const glm::dvec2 origin = origin_cell(goes_to_, {hit.column, hit.row});
  return GeoPosition{transform_.to_crs(origin.x, origin.y),
                     static_cast<double>(sample_bilinear(altitude_m_, origin.x, origin.y)),
                     hit.distance_m};
}

}  // namespace belvedere
