#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/angle.h"
#include "base/math_exact.h"
#include "renderer/trace/camera.h"

namespace belvedere {
namespace {

// A true upright cylinder around the eye, unrolled: x is linear in azimuth, y in the tangent of the
// elevation angle, with square pixels at the horizon. Vertical lines stay vertical. The pitch
// shifts the picture up or down without tilting it.
class CylindricalCamera final : public Camera {
 public:
  explicit CylindricalCamera(const CameraParameters& p) : eye_(p.eye), size_(p.width, p.height) {
    azimuth_ = to_radians(p.azimuth_deg);
    centre_ = projection_middle(p);
    radius_px_ = p.width / to_radians(p.field_of_view_deg);
    horizon_y_ = centre_.y + radius_px_ * exact::tan(to_radians(p.pitch_deg));
  }

  Ray ray(glm::dvec2 pixel) const override {
    const exact::Turn azimuth = exact::turn(azimuth_ + (pixel.x - centre_.x) / radius_px_);
    const double rise = (horizon_y_ - pixel.y) / radius_px_;
    return {eye_, glm::normalize(glm::dvec3(azimuth.sine, azimuth.cosine, rise))};
  }

  std::optional<glm::dvec2> project(glm::dvec3 point) const override {
    const glm::dvec3 q = point - eye_;
    const double level = exact::hypot(q.x, q.y);
    if (!(level > 0.0)) return std::nullopt;  // on the axis there is no azimuth
    // The angle from the picture's centre, -pi…pi: nothing is behind; what is outside the picture
    // is left or right of it.
    const double turn = std::remainder(exact::atan2(q.x, q.y) - azimuth_, 2.0 * std::numbers::pi);
    return glm::dvec2(centre_.x + turn * radius_px_, horizon_y_ - q.z / level * radius_px_);
  }

  glm::dvec3 eye() const override { return eye_; }
  glm::ivec2 size() const override { return size_; }

 private:
  glm::dvec3 eye_;
  glm::ivec2 size_;
  double azimuth_ = 0.0;  // of the picture's centre, rad
  glm::dvec2 centre_;
  double radius_px_ = 1.0;
  double horizon_y_ = 0.0;  // row of level rays, px
};

}  // namespace

std::unique_ptr<Camera> make_cylindrical_camera(const CameraParameters& parameters) {
  check_camera_value("pitch_deg", parameters.pitch_deg, -80, 80);
  return std::make_unique<CylindricalCamera>(parameters);
}

}  // namespace belvedere
