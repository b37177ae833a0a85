#include "renderer/trace/camera.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "base/error.h"
#include "base/math_exact.h"

namespace belvedere {

std::unique_ptr<Camera> make_perspective_camera(const CameraParameters&);
std::unique_ptr<Camera> make_oblique_camera(const CameraParameters&);
std::unique_ptr<Camera> make_cylindrical_camera(const CameraParameters&);
std::unique_ptr<Camera> make_panini_camera(const CameraParameters&);

const std::vector<Projection>& projections() {
  static const std::vector<Projection> all = {
      {"perspective", "central perspective, as in a photograph", 150.0, &make_perspective_camera},
      {"oblique",
       "plan oblique: parallel rays, the ground to scale as on a map, heights drawn upwards", 0.0,
       &make_oblique_camera},
      {"cylindrical", "panorama on an upright cylinder: azimuth is linear across the picture",
       360.0, &make_cylindrical_camera},
      {"panini",
       "wide views without stretched edges: vertical lines stay vertical, lines to the centre "
       "stay straight",
       240.0, &make_panini_camera},
  };
  return all;
}

const Projection* find_projection(std::string_view name) {
  const auto found = std::find_if(projections().begin(), projections().end(),
                                  [&](const Projection& p) { return p.name == name; });
  return found == projections().end() ? nullptr : &*found;
}

ViewAxes view_axes(const CameraParameters& parameters) {
  const double azimuth = to_radians(parameters.azimuth_deg);
  const double pitch = to_radians(parameters.pitch_deg);
  const glm::dvec3 ahead{exact::sin(azimuth), exact::cos(azimuth), 0.0};
  return {{exact::cos(azimuth), -exact::sin(azimuth), 0.0},
          ahead,
          ahead * exact::cos(pitch) + glm::dvec3(0.0, 0.0, exact::sin(pitch))};
}

glm::dvec2 projection_middle(const CameraParameters& p) {
  return 0.5 * glm::dvec2(p.width, p.height) + static_cast<double>(p.width) * p.shift;
}

void check_camera_value(std::string_view field, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return;
  throw Error(ErrorKind::usage, std::string(field), fmt::format("{}", value),
              fmt::format("{} to {}", lowest, highest));
}

std::unique_ptr<Camera> make_camera(const CameraParameters& parameters) {
  check_camera_value("width", parameters.width, 16, 65535);
  check_camera_value("height", parameters.height, 16, 65535);
  // Beyond these a position is not a projected coordinate on Earth, and float distances would be
  // off by metres.
  check_camera_value("eye.x", parameters.eye.x, -1e8, 1e8);
  check_camera_value("eye.y", parameters.eye.y, -1e8, 1e8);
  check_camera_value("eye.z", parameters.eye.z, -1e7, 1e7);
  check_camera_value("shift.x", parameters.shift.x, -1, 1);
  check_camera_value("shift.y", parameters.shift.y, -1, 1);
  check_camera_value("azimuth_deg", parameters.azimuth_deg, -360, 360);
  if (const Projection* projection = find_projection(parameters.projection)) {
    if (projection->widest_deg > 0.0)
      check_camera_value("field_of_view_deg", parameters.field_of_view_deg, 1,
                         projection->widest_deg);
    return projection->make(parameters);
  }
  std::string names;
  for (const Projection& projection : projections())
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", projection.name);
  throw Error(ErrorKind::usage, "projection", fmt::format("\"{}\"", parameters.projection), names);
}

}  // namespace belvedere
