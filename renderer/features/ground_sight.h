#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"
#include "terrain/io/raster.h"

namespace belvedere {

// Position and visibility of map positions on the drawn ground and in the picture: generalized,
// exaggerated, bent, in the finest window that contains them. All calls are safe from any thread;
// the parts must outlive it.
class GroundSight {
 public:
  // goes_to: where each cell's content of the whole surface is drawn after valleys were widened
  // (moved_ground.h); empty: nothing moved.
  GroundSight(const GeoTransform& transform, const DeformedSurface& surface, const Camera& camera,
              const Tracer& tracer, const Grid<glm::vec2>& goes_to);

  // The drawn ground in the deformed world; nothing outside the terrain.
  std::optional<glm::dvec3> ground(glm::dvec2 position) const;
  std::optional<glm::dvec2> pixel(glm::dvec3 point) const { return camera_.project(point); }
  // From the eye, along the line of sight of its pixel.
  double distance_m(glm::dvec3 point, glm::dvec2 pixel) const;
  // The view direction of a pixel.
  glm::dvec3 sight_at(glm::dvec2 pixel) const { return camera_.ray(pixel).direction; }
  // Metres per pixel there, across the line of sight.
  double metres_per_px(glm::dvec3 point, glm::dvec2 pixel) const;

  struct Target {
    glm::dvec3 point;
    glm::dvec2 pixel;
    double distance_m;
  };
  // Distance between each point and the ground in front of it, m; 0 if there is none.
  std::vector<double> hidden_by_m(const std::vector<Target>& targets) const;

  glm::ivec2 size() const { return camera_.size(); }
  // Side of the finest cells, m of the ground.
  double cell_m() const { return cell_m_; }
  // Ground metres per pixel at the picture's lower edge: the median of the ground pixels in the
  // lowest row that has enough of them.
  double nearest_metres_per_px() const;
  // One unit of the CRS is taken as one metre: terrain is metric.
  const GeoTransform& transform() const { return transform_; }
  glm::dvec2 cells() const { return {surface_.vertices_m.width(), surface_.vertices_m.height()}; }

 private:
  GeoTransform transform_;
  const DeformedSurface& surface_;
  const Camera& camera_;
  const Tracer& tracer_;
  const Grid<glm::vec2>& goes_to_;
  double cell_m_;
};

}  // namespace belvedere
