#include "renderer/register/registered_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "base/angle.h"
#include "base/math_exact.h"
#include "terrain/deform/bend_curve.h"

namespace belvedere {
namespace {

namespace unknown = view_unknown;

struct DistanceRange {
  double near_m, far_m;
};

DistanceRange distances_of_pairs(const Registration& found) {
  DistanceRange out{1e9, 0.0};
  for (const DisplacedPlace& place : found.displacement.places) {
    const double distance = view_distance_m(found.frame, found.view, place.position);
    out = {std::min(out.near_m, distance), std::max(out.far_m, distance)};
  }
  return out;
}

// D'(d).
double drop_slope(const Registration& found, double distance_m) {
  constexpr double step_m = 5.0;
  return (view_drop_m(found.frame, found.view, distance_m + step_m) -
          view_drop_m(found.frame, found.view, distance_m - step_m)) /
         (2.0 * step_m);
}

double width_deg(const Registration& found, double width_px) {
  const double half = 0.5 * width_px / found.scale / exact::exp(found.view[unknown::log_focal]);
  switch (found.frame.kind) {
    case ViewKind::cylinder:
      return to_degrees(2.0 * half);
    case ViewKind::panini: {
      const double quarter = half * half / 4.0;
      return to_degrees(2.0 * exact::acos((1.0 - quarter) / (1.0 + quarter)));
    }
    case ViewKind::plane:
      break;
  }
  return to_degrees(2.0 * exact::atan(half));
}

}  // namespace

SceneHandle scene_handle(const DeformHandle& handle) {
  return {.name = "",
          .position = handle.centre,
          .position_lonlat = {},
          .core_m = handle.core_m,
          .move_m = {handle.move_m.x, handle.move_m.y},
          .handle = handle};
}

Scene registered_scene(const Registration& found, glm::ivec2 painting_px) {
  const ViewFrame& frame = found.frame;
  const ViewUnknowns& view = found.view;
  const DistanceRange pairs = distances_of_pairs(found);
  const double width_px = painting_px.x;
  Scene scene;
  scene.output.width = painting_px.x;
  scene.output.height = painting_px.y;

  SceneCamera& camera = scene.camera;
  camera.projection = view_kind_name(frame.kind);
  camera.position =
      frame.origin + frame.extent_m * glm::dvec2(view[unknown::east], view[unknown::north]);
  camera.azimuth_deg = to_degrees(std::remainder(view[unknown::azimuth], to_radians(360.0)));
  camera.field_of_view_deg = width_deg(found, width_px);
  camera.tilt_deg = 0.0;
  camera.shift = {view[unknown::middle], view[unknown::middle + 1]};
  const bool cylinder = frame.kind == ViewKind::cylinder;
  const double level = cylinder ? drop_slope(found, pairs.far_m) : 0.0;
  camera.pitch_deg = cylinder ? to_degrees(exact::atan(level)) : to_degrees(view[unknown::pitch]);

  // Points as far apart as lets a curve through them stay within a tenth of a pixel of the view's.
  constexpr int count = 40;
  constexpr double nearer = 0.8, farther = 1.1, max_inclination_deg = 79.0;
  BendCurve& bend = scene.deform.ground.bend;
  const double from = nearer * pairs.near_m, to = farther * pairs.far_m;
  const double middle_m = std::sqrt(from * to);
  const double exaggeration = view_exaggeration(frame, view, middle_m);
  scene.deform.exaggeration = exaggeration;
  scene.deform.exaggeration_base_m = frame.valley_m;
  for (int i = 0; i < count; ++i) {
    const double distance = from * exact::pow(to / from, static_cast<double>(i) / (count - 1));
    const double inclination = to_degrees(exact::atan(level - drop_slope(found, distance)));
    bend.points.push_back(
        {distance, {}, std::clamp(inclination, -max_inclination_deg, max_inclination_deg)});
    const double factor = view_exaggeration(frame, view, distance) / exaggeration;
    scene.deform.ground.exaggeration_points.push_back({distance, std::clamp(factor, 0.05, 20.0)});
  }
  camera.height_m = frame.valley_m + view_drop_m(frame, view, middle_m) - level * middle_m -
                    BendProfile(bend).drop_m(middle_m);

  for (const DeformHandle& handle : handles_of(found.mountains))
    scene.deform.handles.push_back(scene_handle(handle));
  scene.generalize.valleys.width_m = static_cast<float>(found.valleys_m);
  scene.deform.ground.field = found.displacement;
  scene.deform.ground.field.places.clear();
  for (const DisplacedPlace& place : found.displacement.places)
    scene.deform.field_places.push_back({.name = "",
                                         .position = place.position,
                                         .position_lonlat = {},
                                         .moved_m = {place.moved.lateral_m, place.moved.upward_m},
                                         .noise_m = {place.noise.lateral_m, place.noise.upward_m}});
  return scene;
}

}  // namespace belvedere
