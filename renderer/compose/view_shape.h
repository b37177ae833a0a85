#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

// The shape of a sheet.
struct ViewFormat {
  double aspect = 2.0;     // width over height, 0.5…12
  bool full_turn = false;  // full circle around the viewer, on a cylinder
};

// Bounds of a search for a format.
struct FormatLimits {
  bool cylinder = false;  // wide pictures: a plane would stretch their sides
  double field_of_view_deg = 44.0, min_field_deg = 34.0, max_field_deg = 56.0;
  double near_share = 0.42, min_near = 0.28,
         max_near = 0.66;  // distance of the lower edge, of the horizon's
};
FormatLimits limits_of(const ViewFormat& format);

// A view with its bend: all that a picture's geometry depends on. The ground is first exaggerated
// about a base, then bent by a parabola: level ground at the distance d is tilted towards the
// viewer by (crest - d) / radius. far_m is the horizon of all level ground.
struct ViewShape {
  glm::dvec2 viewer{0.0};
  double azimuth_deg = 0.0;
  double field_of_view_deg = 44.0;  // across
  double aspect = 2.0;
  bool cylinder = false;
  double near_m = 0.0;   // where level ground meets the lower edge
  double far_m = 0.0;    // the horizon: there the line of sight touches bent level ground
  double crest_m = 0.0;  // where bent ground is level
  double exaggeration = 1.5;
  double base_m = 0.0;    // altitude that exaggeration keeps
  double level_m = 0.0;   // level ground above the base, exaggerated
  double radius_m = 0.0;  // of the bend
  double eye_m = 0.0;     // height of the eye
  double pitch_deg = 0.0;

  // How far bent ground sinks, relative to the crest of the parabola.
  double drop_m(double distance_m) const;
  // The tangent by which level ground is tilted towards the viewer.
  double slope(double distance_m) const;
  double raised_m(double altitude_m) const { return base_m + exaggeration * (altitude_m - base_m); }
};

// Position of lines of sight in a picture, 0…1 from its left and upper edge. A line is a level
// direction (to the right, ahead; a unit vector) and the tangent of its depression.
class PictureMap {
 public:
  virtual ~PictureMap() = default;
  virtual glm::dvec2 position(glm::dvec2 direction, double depression) const = 0;
};

class ComposedPicture final : public PictureMap {
 public:
  explicit ComposedPicture(const ViewShape& view);
  glm::dvec2 position(glm::dvec2 direction, double depression) const override;

 private:
  bool cylinder_ = false;
  double half_width_ = 1.0,
         half_height_ =
             1.0;  // tangents; of a cylinder half of its angle, and tangents of elevation
  double cosine_ = 1.0, sine_ = 0.0;  // of the pitch, downwards
  double centre_ = 0.0;               // of a cylinder: the tangent of depression at the centre
};

// Height of the picture as an angle: 2 atan(tan(field / 2) / aspect); of a cylinder the field over
// the aspect, in tangents.
double picture_height(const ViewShape& view);
// Level directions (right, ahead) evenly over the picture's width, and a little beyond its edges
// where a tilted picture shows more below.
std::vector<glm::dvec2> fan_directions(double field_of_view_deg, bool cylinder, int columns);
// Bit-identical on all machines; angles in radians.
double tangent(double angle_rad);
// (right, ahead) to (east, north).
glm::dvec2 to_map(glm::dvec2 direction, double azimuth_deg);
// Distances from `from` to `to` with equal ratios.
std::vector<double> growing_distances(double from, double to, int count);

// Defaults of a view: shares of the distance of its horizon, light by its direction. Proposed views
// are written with these, and scenes that leave them open get them; other defaults:
// complete_view.h.

struct HorizonDefaults {
  double air_from_m = 0.0;         // .45 of the horizon's distance: behind the foreground
  double air_scale_m = 0.0;        // .60: far ranges turn blue but stay readable
  double rim_fade_m = 0.0;         // .035: the end of the data disappears in haze
  double foreground_to_m = 0.0;    // .42: where generalization begins to change
  double background_from_m = 0.0;  // .95
};
// Upper limit of the haze's share.
inline constexpr double view_haze = 0.80;
HorizonDefaults defaults_of_horizon(double far_m);

// Light as in painted panoramas: from the upper left, as on maps.
struct PainterSun {
  double azimuth_deg = 0.0;  // 0…360
  double altitude_deg = 0.0;
};
PainterSun painter_sun(double view_azimuth_deg);

// Values rounded to four figures, the precision that a picture can show.
double rounded_m(double metres);
// To a multiple of 1 / parts.
double rounded_to(double value, double parts);
// 0…360.
double turned_deg(double degrees);

}  // namespace belvedere
