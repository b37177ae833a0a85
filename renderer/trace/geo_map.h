#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"
#include "terrain/io/raster.h"

namespace belvedere {

// Where a geographic point lies in the picture.
struct ImagePlace {
  glm::dvec2 pixel{0.0};     // x right, y down, (0, 0) the outer corner of the top-left pixel; may lie outside the picture
  glm::dvec3 deformed{0.0};  // in the deformed world
  double distance_m = 0.0;   // from the eye, along the line of sight
  bool in_picture = false;
  bool visible = false;  // in the picture, and no ground stands in front of it
};

// What a pixel shows.
struct GeoPlace {
  glm::dvec2 place{0.0};    // undeformed, scene CRS
  double altitude_m = 0.0;  // of the undeformed, ungeneralized DEM
  double distance_m = 0.0;  // from the eye, along the line of sight
};

// The map from geography to the picture and back, through everything that generalization, deformation and camera do: what labels, rivers,
// routes and a click on the picture need. Exact: a ground point's ray meets the same facet again, far below a pixel away. All calls are
// safe from any thread; the parts must outlive the map.
class GeoMap {
 public:
  // altitude_m: the undeformed, ungeneralized DEM, with as many cells as the surface has posts. goes_to: where what
  // lies on each cell is drawn in widened valleys (terrain/generalize/moved_ground.h); empty where nothing moved.
  GeoMap(const Grid<float>& altitude_m, const Grid<glm::vec2>& goes_to, const GeoTransform& transform, const Deformation& deformation,
         const DeformedSurface& surface, const Camera& camera, const Tracer& tracer);

  // A place on the ground as it is drawn. Nothing outside the terrain, or behind the eye.
  std::optional<ImagePlace> to_image(glm::dvec2 place) const;
  // A point at an altitude above the datum, on the ground, above or below it, moved as ground at that place and altitude would be.
  // Nothing behind the eye.
  std::optional<ImagePlace> to_image(glm::dvec3 place) const;
  // The ground that a place of the picture shows; nothing where it shows sky.
  std::optional<GeoPlace> to_geo(glm::dvec2 pixel) const;
  // The drawn ground in the deformed world; nothing outside the terrain.
  std::optional<glm::dvec3> on_surface(glm::dvec2 place) const;

  // Widened valleys move ground, with all that lies on it. Where ground of a place is drawn on the map, and the place whose ground is drawn
  // there; themselves where nothing moved.
  glm::dvec2 drawn_place(glm::dvec2 place) const;
  glm::dvec2 place_of_drawn(glm::dvec2 drawn) const;
  // to_image() of a place that is known as a drawn one.
  std::optional<ImagePlace> drawn_to_image(glm::dvec2 drawn) const;

 private:
  std::optional<glm::dvec3> drawn_surface(glm::dvec2 drawn) const;
  std::optional<ImagePlace> see(glm::dvec3 deformed) const;

  const Grid<float>& altitude_m_;
  const Grid<glm::vec2>& goes_to_;
  GeoTransform transform_;
  const Deformation& deformation_;
  const DeformedSurface& surface_;
  const Camera& camera_;
  const Tracer& tracer_;
};

}  // namespace belvedere
