#include "renderer/compose/view_shape.h"

#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"

namespace belvedere {
namespace {

double arc_tangent_deg(double tangent) { return to_degrees(exact::atan2(tangent, 1.0)); }

}  // namespace

double tangent(double angle_rad) {
  const exact::Turn turn = exact::turn(angle_rad);
  return turn.sine / turn.cosine;
}

FormatLimits limits_of(const ViewFormat& format) {
  FormatLimits out;
  if (format.full_turn) {
    // A ring of ground: the far half of it is as near to the viewer as the near half, so the lower
    // edge comes closer.
    out = {.cylinder = true,
           .field_of_view_deg = 360.0,
           .min_field_deg = 360.0,
           .max_field_deg = 360.0,
           .near_share = 0.3,
           .min_near = 0.16,
           .max_near = 0.5};
    return out;
  }
  // A field that is wider by the square root of the aspect: half of the additional length of a
  // sheet widens the view, half makes the strip of land lower.
  const double grow = std::sqrt(format.aspect / 2.0);
  constexpr double usual = 22.0, min = 17.0, max = 28.0;  // halves, for 2 : 1
  out.field_of_view_deg = 2.0 * arc_tangent_deg(grow * tangent(to_radians(usual)));
  out.min_field_deg = 2.0 * arc_tangent_deg(grow * tangent(to_radians(min)));
  out.max_field_deg = 2.0 * arc_tangent_deg(grow * tangent(to_radians(max)));
  constexpr double widest_plane = 3.2;
  out.cylinder = format.aspect > widest_plane;
  return out;
}

double ViewShape::drop_m(double distance_m) const {
  return square(distance_m - crest_m) / (2.0 * radius_m);
}
double ViewShape::slope(double distance_m) const { return (crest_m - distance_m) / radius_m; }

double picture_height(const ViewShape& view) {
  const double width = to_radians(view.field_of_view_deg);
  if (view.cylinder) return width / view.aspect;
  return 2.0 * exact::atan2(tangent(0.5 * width) / view.aspect, 1.0);
}

ComposedPicture::ComposedPicture(const ViewShape& view) : cylinder_(view.cylinder) {
  const double half = to_radians(0.5 * view.field_of_view_deg);
  const double down = to_radians(-view.pitch_deg);
  const exact::Turn turn = exact::turn(down);
  cosine_ = turn.cosine;
  sine_ = turn.sine;
  centre_ = sine_ / cosine_;
  half_width_ = cylinder_ ? half : tangent(half);
  half_height_ = half_width_ / view.aspect;
}

glm::dvec2 ComposedPicture::position(glm::dvec2 direction, double depression) const {
  if (cylinder_)
    return {0.5 + 0.5 * exact::atan2(direction.x, direction.y) / half_width_,
            0.5 + 0.5 * (depression - centre_) / half_height_};
  const double depth = direction.y * cosine_ + depression * sine_;
  const double up = direction.y * sine_ - depression * cosine_;
  if (!(depth > 1e-9))
    return {0.5 + 1e6 * direction.x, 1e6};  // below or behind what a plane can show
  return {0.5 + 0.5 * direction.x / (depth * half_width_), 0.5 - 0.5 * up / (depth * half_height_)};
}

std::vector<glm::dvec2> fan_directions(double field_of_view_deg, bool cylinder, int columns) {
  constexpr double beyond = 1.12;
  const double half = to_radians(0.5 * field_of_view_deg);
  const bool full = field_of_view_deg >= 359.0;
  const double widest = full ? 1.0 - 1.0 / columns : beyond;
  std::vector<glm::dvec2> out;
  out.reserve(static_cast<std::size_t>(columns));
  const double tan_half = cylinder ? 0.0 : tangent(half);
  for (int k = 0; k < columns; ++k) {
    const double across = widest * (2.0 * k / (columns - 1) - 1.0);
    if (cylinder) {
      const exact::Turn turn = exact::turn(across * half);
      out.emplace_back(turn.sine, turn.cosine);
    } else {
      const double right = across * tan_half;
      const double length = std::sqrt(1.0 + right * right);
      out.emplace_back(right / length, 1.0 / length);
    }
  }
  return out;
}

glm::dvec2 to_map(glm::dvec2 direction, double azimuth_deg) {
  const exact::Turn turn = exact::turn(to_radians(azimuth_deg));
  return {direction.x * turn.cosine + direction.y * turn.sine,
          direction.y * turn.cosine - direction.x * turn.sine};
}

std::vector<double> growing_distances(double from, double to, int count) {
  const double ratio = exact::exp2(exact::log2(to / from) / (count - 1));
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(count));
  double distance = from;
  for (int k = 0; k < count; ++k, distance *= ratio) out.push_back(distance);
  return out;
}

HorizonDefaults defaults_of_horizon(double far_m) {
  return {.air_from_m = 0.45 * far_m,
          .air_scale_m = 0.60 * far_m,
          .rim_fade_m = 0.035 * far_m,
          .foreground_to_m = 0.42 * far_m,
          .background_from_m = 0.95 * far_m};
}

PainterSun painter_sun(double view_azimuth_deg) {
  constexpr double left_deg = 112.0, altitude_deg = 31.0;
  return {turned_deg(view_azimuth_deg - left_deg), altitude_deg};
}

double rounded_m(double metres) {
  double unit = 1.0;
  while (metres / unit >= 10000.0) unit *= 10.0;
  return std::round(metres / unit) * unit;
}

double rounded_to(double value, double parts) { return std::round(value * parts) / parts; }

double turned_deg(double degrees) { return degrees - 360.0 * std::floor(degrees / 360.0); }

}  // namespace belvedere
