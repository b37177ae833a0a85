#include <cmath>
#include <glm/geometric.hpp>

#include "base/angle.h"
#include "base/math_exact.h"
#include "renderer/trace/camera.h"

namespace belvedere {
namespace {

// A plane picture at `focal_px` in front of the eye; square pixels.
class PerspectiveCamera final : public Camera {
 public:
  explicit PerspectiveCamera(const CameraParameters& p) : eye_(p.eye), size_(p.width, p.height) {
    const ViewAxes axes = view_axes(p);
    right_ = axes.right;
    forward_ = axes.forward;
    up_ = glm::cross(right_, forward_);
    centre_ = projection_middle(p);
    focal_px_ = 0.5 * p.width / exact::tan(0.5 * to_radians(p.field_of_view_deg));
  }

  Ray ray(glm::dvec2 pixel) const override {
    const glm::dvec2 offset = pixel - centre_;
    return {eye_, glm::normalize(forward_ * focal_px_ + right_ * offset.x - up_ * offset.y)};
  }

  std::optional<glm::dvec2> project(glm::dvec3 point) const override {
    const glm::dvec3 q = point - eye_;
    const double depth = glm::dot(q, forward_);
    if (!(depth > 0.0)) return std::nullopt;
    const double scale = focal_px_ / depth;
    return centre_ + glm::dvec2(glm::dot(q, right_), -glm::dot(q, up_)) * scale;
  }

  glm::dvec3 eye() const override { return eye_; }
  glm::ivec2 size() const override { return size_; }

 private:
  glm::dvec3 eye_;
  glm::ivec2 size_;
  glm::dvec3 right_, forward_, up_;  // orthonormal
  glm::dvec2 centre_;
  double focal_px_ = 1.0;
};

}  // namespace

std::unique_ptr<Camera> make_perspective_camera(const CameraParameters& parameters) {
  check_camera_value("pitch_deg", parameters.pitch_deg, -90, 90);
  return std::make_unique<PerspectiveCamera>(parameters);
}

}  // namespace belvedere
