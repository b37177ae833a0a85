#include "renderer/trace/camera_panini.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "base/angle.h"
#include "base/math_exact.h"

namespace belvedere {
namespace {

// The general Pannini projection (Sharpless, Postle, German, "Pannini: A New Projection for
// Rendering Wide Angle Perspective Images", 2010): the view is mapped to an upright cylinder of
// radius 1 around the eye, and that is projected onto a plane from a point d behind the eye:
//   S = (d + 1) / (d + cos φ)    x = S sin φ    y = S tan θ
// φ is the angle from the picture's centre, θ the elevation. Vertical lines stay vertical, and
// straight lines to the centre stay straight. The pitch shifts the picture up or down without
// tilting it. Rays are computed without an angle, so they are the same on all machines.
class PaniniCamera final : public Camera {
 public:
  PaniniCamera(const CameraParameters& p, double distance)
      : eye_(p.eye), size_(p.width, p.height), d_(distance) {
    const ViewAxes axes = view_axes(p);
    right_ = axes.right;
    ahead_ = axes.ahead;
    centre_ = projection_middle(p);
    const double half = 0.5 * to_radians(p.field_of_view_deg);
    unit_px_ = 0.5 * p.width / (widening(exact::cos(half)) * exact::sin(half));
    horizon_y_ = centre_.y + unit_px_ * exact::tan(to_radians(p.pitch_deg));
  }

  Ray ray(glm::dvec2 pixel) const override {
    const double x = (pixel.x - centre_.x) / unit_px_;
    const double y = (horizon_y_ - pixel.y) / unit_px_;
    // x = S sin φ solved for cos φ: (k + 1) cos² φ + 2 k d cos φ + k d² - 1 = 0 with k = x² / (d +
    // 1)², the larger root.
    const double k = x * x / ((d_ + 1.0) * (d_ + 1.0));
    const double cosine = (std::sqrt(1.0 + k * (1.0 - d_ * d_)) - k * d_) / (k + 1.0);
    const double s = widening(cosine);
    return {eye_, glm::normalize(ahead_ * cosine + right_ * (x / s) + glm::dvec3(0.0, 0.0, y / s))};
  }

  std::optional<glm::dvec2> project(glm::dvec3 point) const override {
    const glm::dvec3 q = point - eye_;
    const double level = exact::hypot(q.x, q.y);
    if (!(level > 0.0)) return std::nullopt;  // on the axis there is no azimuth
    const double cosine = glm::dot(q, ahead_) / level;
    if (!(d_ + cosine > 0.0)) return std::nullopt;  // behind the centre of projection
    const double scale = widening(cosine) * unit_px_ / level;
    return glm::dvec2(centre_.x + scale * glm::dot(q, right_), horizon_y_ - scale * q.z);
  }

  glm::dvec3 eye() const override { return eye_; }
  glm::ivec2 size() const override { return size_; }

 private:
  double widening(double cosine) const { return (d_ + 1.0) / (d_ + cosine); }  // S

  glm::dvec3 eye_;
  glm::ivec2 size_;
  double d_;
  glm::dvec3 right_, ahead_;  // level
  glm::dvec2 centre_;
  double unit_px_ = 1.0;    // of x and y above
  double horizon_y_ = 0.0;  // row of level rays in the picture's centre, px
};

}  // namespace

std::unique_ptr<Camera> make_panini_camera(const CameraParameters& parameters, double distance) {
  check_camera_value("pitch_deg", parameters.pitch_deg, -80, 80);
  return std::make_unique<PaniniCamera>(parameters, distance);
}

std::unique_ptr<Camera> make_panini_camera(const CameraParameters& parameters) {
  return make_panini_camera(parameters, 1.0);
}

}  // namespace belvedere
