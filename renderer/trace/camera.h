#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace belvedere {

struct Ray {
  glm::dvec3 origin;
  glm::dvec3 direction;  // unit
};

// How the picture sees the deformed world (x east, y north, z up, metres, scene CRS). Image places are in pixels,
// x right, y down, (0, 0) the outer corner of the top-left pixel. A camera is immutable; all calls are safe from any thread.
class Camera {
 public:
  virtual ~Camera() = default;
  virtual Ray ray(glm::dvec2 pixel) const = 0;
  // The image place of a point, or nothing where it lies behind the eye; places outside the picture are returned as they are.
  virtual std::optional<glm::dvec2> project(glm::dvec3 point) const = 0;
  // The place distances and generalization count from; for parallel projections the origin of the near picture edge's middle ray.
  virtual glm::dvec3 eye() const = 0;
  virtual glm::ivec2 size() const = 0;
};

struct CameraParameters {
  std::string projection = "perspective";  // a name of projections()
  int width = 2400;                        // px, 16…65535
  int height = 1100;                       // px, 16…65535
  glm::dvec3 eye{0.0};                     // deformed world, m; the picture's middle ray passes through it
  double azimuth_deg = 0.0;                // view direction, clockwise from north
  double pitch_deg = -20.0;                // perspective -90 straight down … 90, oblique -90…-5, cylindrical and panini -80…80
  double field_of_view_deg = 50.0;         // horizontal; 1…widest_deg of the projection
  double view_width_m = 20000.0;           // oblique: width of the picture on the ground, 1…1e7
};

// A projection is one file with its maker, declared and listed in camera.cpp: see CONTRIBUTING.
using ProjectionMaker = std::unique_ptr<Camera> (*)(const CameraParameters&);
struct Projection {
  std::string_view name;
  std::string_view meaning;  // a line for the documentation
  double widest_deg = 0.0;   // greatest field of view; 0: rays are parallel, and the width of the view is in metres
  ProjectionMaker make = nullptr;
};
const std::vector<Projection>& projections();
// Null where there is none of that name.
const Projection* find_projection(std::string_view name);

// Throws Error(usage) for an unknown projection or values out of range, naming the field.
std::unique_ptr<Camera> make_camera(const CameraParameters& parameters);

// Unit vectors of a view, for the makers. `right` and `ahead` are level whatever the pitch, so looking straight down still has the
// azimuth's direction on top; `forward` is `ahead` turned up by the pitch. `right` is square to both.
struct ViewAxes {
  glm::dvec3 right;
  glm::dvec3 ahead;
  glm::dvec3 forward;
};
ViewAxes view_axes(const CameraParameters& parameters);

// Throws Error(usage) unless lowest <= value <= highest (so NaN as well); for the makers. field: "pitch_deg".
void check_camera_value(std::string_view field, double value, double lowest, double highest);

}  // namespace belvedere
