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

// Where places of the map lie on the drawn ground and in the picture: generalized, exaggerated, bent, of the finest window that holds them.
// All calls are safe from any thread; the parts must outlive it.
class GroundSight {
 public:
  // goes_to: where what lies on each cell of the whole surface is drawn in widened valleys (moved_ground.h); empty: nothing moved.
  GroundSight(const GeoTransform& transform, const DeformedSurface& surface, const Camera& camera, const Tracer& tracer,
              const Grid<glm::vec2>& goes_to);

  // The drawn ground in the deformed world; nothing outside the terrain.
  std::optional<glm::dvec3> ground(glm::dvec2 place) const;
  std::optional<glm::dvec2> pixel(glm::dvec3 point) const { return camera_.project(point); }
  // From the eye, along the line of sight of its pixel.
  double distance_m(glm::dvec3 point, glm::dvec2 pixel) const;
  // The direction in which a pixel looks.
  glm::dvec3 sight_at(glm::dvec2 pixel) const { return camera_.ray(pixel).direction; }
  // How many metres across the line of sight a pixel shows there.
  double metres_per_px(glm::dvec3 point, glm::dvec2 pixel) const;

  struct Target {
    glm::dvec3 point;
    glm::dvec2 pixel;
    double distance_m;
  };
  // How much nearer than each point ground stands before it, m; 0 where none does.
  std::vector<double> hidden_by_m(const std::vector<Target>& targets) const;

  glm::ivec2 size() const { return camera_.size(); }
  // Side of the finest cells, m of the ground.
  double cell_m() const { return cell_m_; }
  // Metres that a pixel shows of the ground at the picture's lower edge: the median of what is ground there, or above it.
  double nearest_metres_per_px() const;
  // One unit of the CRS in metres is taken as one: terrain is metric.
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
