#include <glm/geometric.hpp>

#include "renderer/trace/camera.h"

namespace belvedere {
namespace {

// Plan oblique (Jenny & Patterson 2007): all rays are parallel, azimuth across, pitch down; the
// picture is the horizontal plane through the eye, with the azimuth's direction on top. So level
// ground keeps one scale in every direction, as on a map, and a summit stands h / tan(-pitch) above
// its foot. With pitch -90 it is a plain map. Points above the plane are behind the eye.
class ObliqueCamera final : public Camera {
 public:
  explicit ObliqueCamera(const CameraParameters& p)
      : centre_origin_(p.eye), size_(p.width, p.height) {
    const ViewAxes axes = view_axes(p);
    right_ = axes.right;
    up_ = axes.ahead;
    direction_ = glm::normalize(axes.forward);
    centre_ = projection_middle(p);
    metres_per_px_ = p.view_width_m / p.width;
  }

  Ray ray(glm::dvec2 pixel) const override {
    const glm::dvec2 offset = (pixel - centre_) * metres_per_px_;
    return {centre_origin_ + right_ * offset.x - up_ * offset.y, direction_};
  }

  std::optional<glm::dvec2> project(glm::dvec3 point) const override {
    const glm::dvec3 q = point - centre_origin_;
    const double distance = q.z / direction_.z;
    if (!(distance > 0.0)) return std::nullopt;
    const glm::dvec3 origin = q - direction_ * distance;
    return centre_ + glm::dvec2(glm::dot(origin, right_), -glm::dot(origin, up_)) / metres_per_px_;
  }

  glm::dvec3 eye() const override { return ray({centre_.x, size_.y}).origin; }
  glm::ivec2 size() const override { return size_; }

 private:
  glm::dvec3 centre_origin_;
  glm::ivec2 size_;
  glm::dvec3 right_, up_;  // level: the picture's axes on the ground
  glm::dvec3 direction_;
  glm::dvec2 centre_;
  double metres_per_px_ = 1.0;
};

}  // namespace

std::unique_ptr<Camera> make_oblique_camera(const CameraParameters& parameters) {
  check_camera_value("pitch_deg", parameters.pitch_deg, -90, -5);
  check_camera_value("view_width_m", parameters.view_width_m, 1, 1e7);
  return std::make_unique<ObliqueCamera>(parameters);
}

}  // namespace belvedere
