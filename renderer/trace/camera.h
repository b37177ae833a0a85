#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"

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

// The table's projection has distance 1. distance: from the axis of the cylinder back to the centre
// of projection, in radii of the cylinder. 0 is a perspective whose vertical lines stay vertical, 1
// the Pannini projection, stereographic horizontally.
std::unique_ptr<Camera> make_panini_camera(const CameraParameters& parameters, double distance);

// Another camera's view in a picture whose pixels are `factor` times as wide and high: the same
// rays, fewer of them. Its size is rounded up, so its last column and row may extend beyond the
// edge of the whole picture. `whole` must outlive it.
std::unique_ptr<const Camera> make_reduced_camera(const Camera& whole, int factor);

// The surroundings that a stage reads beyond its own pixels: the same picture in pixels `factor`
// times as wide and high, one ray each. Wide effects (ribs, lanes of forests, mist between ranges,
// forest around) are smooth over half a unit of the sheet, so a print need not read every pixel of
// its surroundings; where a unit is less than four pixels the factor is 1 and these are the pixels
// themselves. Holds depth, position, mapped class and fall line; for rock, normal and footprint (of
// its own pixels) instead of the position.
struct WideView {
  const GuidanceBuffers& seen;
  int factor = 1;
  glm::ivec2 origin_px{0};  // of `seen`, in its own pixels
  // The fall lines of the same pixels after smooth_fall_lines (renderer/rock/spurs.h); null:
  // computed by each reader.
  const Grid<glm::vec2>* smooth_fall = nullptr;

  // Column or row of `seen` that contains a column or row of the sheet (0…65535); otherwise the
  // nearest.
  int column(int sheet_x) const { return position(sheet_x, origin_px.x, seen.width()); }
  int row(int sheet_y) const { return position(sheet_y, origin_px.y, seen.height()); }
  // Whether it contains a position, that is, within the sheet where it reaches far enough.
  bool holds(int sheet_x, int sheet_y) const {
    const int x = sheet_x - origin_px.x * factor;
    const int y = sheet_y - origin_px.y * factor;
    return sheet_x >= 0 && sheet_y >= 0 && x >= 0 && y >= 0 && x < seen.width() * factor &&
           y < seen.height() * factor;
  }
  std::size_t index(int sheet_x, int sheet_y) const {
    return seen.depth_m.index(column(sheet_x), row(sheet_y));
  }

 private:
  int position(int sheet, int origin, int count) const {
    return std::clamp(std::max(sheet, 0) / factor - origin, 0, count - 1);
  }
};

// Every `times`-th pixel of a wide view in each direction, at the same positions whatever its
// window; pixels at its edge stand for cells that it contains in part. Without positions.
GuidanceBuffers thin_out(const WideView& wide, int times);
glm::ivec2 thinned_origin(const WideView& wide, int times);

// Sheet pixels per wide pixel, so that two remain per unit of the sheet.
int wide_factor(double pixels_per_unit);
// The wide pixels that contain a rectangle of the sheet, and those whose centres are on either side
// of its border.
PixelRect wide_rect(PixelRect sheet_rect, int factor);

}  // namespace belvedere
