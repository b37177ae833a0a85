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

// Projection of the deformed world (x east, y north, z up, metres, scene CRS) to the picture. Image
// positions are in pixels, x right, y down, (0, 0) the outer corner of the top-left pixel. A camera
// is immutable; all calls are safe from any thread.
class Camera {
 public:
  virtual ~Camera() = default;
  virtual Ray ray(glm::dvec2 pixel) const = 0;
  // The image position of a point, or nothing where it is behind the eye; positions outside the
  // picture are returned too.
  virtual std::optional<glm::dvec2> project(glm::dvec3 point) const = 0;
  // The origin of distances and generalization; for parallel projections the origin of the ray
  // through the centre of the near picture edge.
  virtual glm::dvec3 eye() const = 0;
  virtual glm::ivec2 size() const = 0;
};

struct CameraParameters {
  std::string projection = "perspective";  // a name of projections()
  int width = 2400;                        // px, 16…65535
  int height = 1100;                       // px, 16…65535
  glm::dvec3 eye{0.0};       // deformed world, m; the picture's central ray passes through it
  double azimuth_deg = 0.0;  // view direction, clockwise from north
  double pitch_deg =
      -20.0;  // perspective -90 straight down … 90, oblique -90…-5, cylindrical and panini -80…80
  double field_of_view_deg = 50.0;  // horizontal; 1…widest_deg of the projection
  // The middle of the projection from the picture's centre, right and down, in widths of the
  // picture, -1…1: of a picture that was cropped on one side.
  glm::dvec2 shift{0.0};
  double view_width_m = 20000.0;  // oblique: width of the picture on the ground, 1…1e7
};

// A projection is one file with its factory, declared and listed in camera.cpp: see CONTRIBUTING.
using ProjectionMaker = std::unique_ptr<Camera> (*)(const CameraParameters&);
struct Projection {
  std::string_view name;
  std::string_view meaning;  // one line for the documentation
  double widest_deg =
      0.0;  // max field of view; 0: rays are parallel, and the width of the view is in metres
  ProjectionMaker make = nullptr;
};
const std::vector<Projection>& projections();
// Null for an unknown name.
const Projection* find_projection(std::string_view name);

// Throws Error(usage) for an unknown projection or values out of range; the message names the
// field.
std::unique_ptr<Camera> make_camera(const CameraParameters& parameters);

// Unit vectors of a view, for the factories. `right` and `ahead` are level whatever the pitch, so
// looking straight down still has the azimuth's direction on top; `forward` is `ahead` turned up by
// the pitch. `right` is perpendicular to both.
struct ViewAxes {
  glm::dvec3 right;
  glm::dvec3 ahead;
  glm::dvec3 forward;
};
ViewAxes view_axes(const CameraParameters& parameters);

// The middle of the projection, px.
glm::dvec2 projection_middle(const CameraParameters& parameters);

// Throws Error(usage) unless lowest <= value <= highest (also for NaN); for the factories. field:
// "pitch_deg".
void check_camera_value(std::string_view field, double value, double lowest, double highest);

}  // namespace belvedere
