#include "renderer/trace/camera.h"

#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"

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

namespace {

class ReducedCamera final : public Camera {
 public:
  ReducedCamera(const Camera& whole, int factor) : whole_(whole), factor_(factor) {}
  Ray ray(glm::dvec2 pixel) const override {
    return whole_.ray(pixel * static_cast<double>(factor_));
  }
  std::optional<glm::dvec2> project(glm::dvec3 point) const override {
    std::optional<glm::dvec2> position = whole_.project(point);
    if (position) *position /= static_cast<double>(factor_);
    return position;
  }
  glm::dvec3 eye() const override { return whole_.eye(); }
  glm::ivec2 size() const override { return (whole_.size() + factor_ - 1) / factor_; }

 private:
  const Camera& whole_;
  int factor_;
};

}  // namespace

std::unique_ptr<const Camera> make_reduced_camera(const Camera& whole, int factor) {
  if (factor < 1)
    throw Error(ErrorKind::bug, "reduced camera", fmt::format("a factor of {}", factor),
                "1 or more");
  return std::make_unique<ReducedCamera>(whole, factor);
}

namespace {

constexpr double min_pixels_per_unit = 2.0;  // of a wide view

}  // namespace

int wide_factor(double pixels_per_unit) {
  return std::max(1, static_cast<int>(std::floor(pixels_per_unit / min_pixels_per_unit)));
}

glm::ivec2 thinned_origin(const WideView& wide, int times) { return wide.origin_px / times; }

GuidanceBuffers thin_out(const WideView& wide, int times) {
  const GuidanceBuffers& seen = wide.seen;
  const glm::ivec2 first = thinned_origin(wide, times);
  const glm::ivec2 size =
      (wide.origin_px + glm::ivec2(seen.width(), seen.height()) + times - 1) / times - first;
  GuidanceBuffers thin;
  thin.origin_m = seen.origin_m;
  thin.depth_m = thin.footprint_m = Grid<float>(size.x, size.y);
  thin.land_cover = Grid<LandCoverClass>(size.x, size.y);
  thin.fall_line = Grid<glm::vec2>(size.x, size.y);
  thin.normal = Grid<glm::vec3>(size.x, size.y);
  parallel_ranges(size.y, 16, [&](int begin, int end) {
    for (int y = begin; y != end; ++y)
      for (int x = 0; x < size.x; ++x) {
        const glm::ivec2 centre = (first + glm::ivec2(x, y)) * times + times / 2 - wide.origin_px;
        const std::size_t from = seen.depth_m.index(std::clamp(centre.x, 0, seen.width() - 1),
                                                    std::clamp(centre.y, 0, seen.height() - 1));
        const std::size_t to = thin.depth_m.index(x, y);
        thin.depth_m[to] = seen.depth_m[from];
        thin.footprint_m[to] = seen.footprint_m[from] * static_cast<float>(times);
        thin.land_cover[to] = seen.land_cover[from];
        thin.fall_line[to] = seen.fall_line[from];
        thin.normal[to] = seen.normal[from];
      }
  });
  return thin;
}

PixelRect wide_rect(PixelRect r, int factor) {
  const auto down = [factor](int v) { return v >= 0 ? v / factor : -((-v + factor - 1) / factor); };
  return grown({down(r.x0), down(r.y0), down(r.x1 + factor - 1), down(r.y1 + factor - 1)},
               factor == 1 ? 0 : 1);
}

}  // namespace belvedere
