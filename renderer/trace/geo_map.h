#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"
#include "terrain/io/raster.h"

namespace belvedere {

// The position of a geographic point in the picture.
struct ImagePosition {
  glm::dvec2 pixel{0.0};  // x right, y down, (0, 0) the outer corner of the top-left pixel; may lie
                          // outside the picture
  glm::dvec3 deformed{0.0};  // in the deformed world
  double distance_m = 0.0;   // from the eye, along the line of sight
  bool in_picture = false;
  bool visible = false;  // in the picture, and not hidden by ground
};

// The ground shown by a pixel.
struct GeoPosition {
  glm::dvec2 position{0.0};  // undeformed, scene CRS
  double altitude_m = 0.0;   // of the undeformed, ungeneralized DEM
  double distance_m = 0.0;   // from the eye, along the line of sight
};

// The mapping from geography to the picture and back, including generalization, deformation and
// camera, for labels, rivers, routes and clicks on the picture. Exact: a ground point's ray hits
// the same facet again, far below a pixel away. All calls are safe from any thread; the parts must
// outlive the map.
class GeoMap {
 public:
  // altitude_m: the undeformed, ungeneralized DEM, with as many cells as the surface has posts.
  // goes_to: where each cell's content is drawn after valleys were widened
  // (terrain/generalize/widen_valleys.h); empty where nothing moved.
  GeoMap(const Grid<float>& altitude_m, const Grid<glm::vec2>& goes_to,
         const GeoTransform& transform, const Deformation& deformation,
         const DeformedSurface& surface, const Camera& camera, const Tracer& tracer);

  // A position on the ground as drawn. Nothing outside the terrain, or behind the eye.
  std::optional<ImagePosition> to_image(glm::dvec2 position) const;
  // A point at an altitude above the datum, on, above or below the ground, moved as ground at that
  // position and altitude would be. Nothing behind the eye.
  std::optional<ImagePosition> to_image(glm::dvec3 position) const;
  // The ground at a position of the picture; nothing where it shows sky.
  std::optional<GeoPosition> to_geo(glm::dvec2 pixel) const;
  // The drawn ground in the deformed world; nothing outside the terrain.
  std::optional<glm::dvec3> on_surface(glm::dvec2 position) const;

  // Widened valleys move the ground with everything on it. Where the ground of a position is drawn
  // on the map, and the position whose ground is drawn there; unchanged where nothing moved.
  glm::dvec2 drawn_position(glm::dvec2 position) const;
  glm::dvec2 position_of_drawn(glm::dvec2 drawn) const;
  // to_image() of a position that is already a drawn one.
  std::optional<ImagePosition> drawn_to_image(glm::dvec2 drawn) const;

 private:
  std::optional<glm::dvec3> drawn_surface(glm::dvec2 drawn) const;
  std::optional<ImagePosition> see(glm::dvec3 deformed) const;

  const Grid<float>& altitude_m_;
  const Grid<glm::vec2>& goes_to_;
  GeoTransform transform_;
  const Deformation& deformation_;
  const DeformedSurface& surface_;
  const Camera& camera_;
  const Tracer& tracer_;
};

}  // namespace belvedere
