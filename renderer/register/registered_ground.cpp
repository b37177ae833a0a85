#include "renderer/register/registered_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "terrain/deform/bend_curve.h"
#include "terrain/register/mountain_deviation.h"

namespace belvedere {
namespace {

View view_of_size(const Scene& scene, const Dem& dem, glm::ivec2 size_px, Progress& progress) {
  Scene sized = scene;
  sized.output.width = size_px.x;
  sized.output.height = size_px.y;
  return make_view(sized, dem, progress);
}

}  // namespace

RegisteredView::RegisteredView(const Registration& registration, const Scene& scene, const Dem& dem,
                               glm::ivec2 size_px, Progress& progress)
    : RegisteredView(registration, dem, view_of_size(scene, dem, size_px, progress)) {}

RegisteredView::RegisteredView(const Registration& registration, const Dem& dem, const View& view)
    : registration_(registration),
      dem_(dem),
      deformation_(view.deform, view.viewer_xy),
      surface_(
          deform(dem.altitude_m, dem.transform, glm::dvec3(view.viewer_xy, 0.0), deformation_)),
      camera_(make_camera(view.camera)),
      tracer_(surface_),
      map_(dem.altitude_m, nothing_moved_, dem.transform, deformation_, surface_, *camera_,
           tracer_) {}

namespace {

constexpr float unknown_value = std::numeric_limits<float>::quiet_NaN();

// The normal of ground that handles carry with them.
glm::vec3 carried(const HandleField& handles, glm::dvec2 position, glm::vec3 normal) {
  const glm::dvec2 low = handles.lowest(), high = handles.highest();
  if (handles.is_identity() || position.x < low.x || position.y < low.y || position.x > high.x ||
      position.y > high.y)
    return normal;
  constexpr double step_m = 5.0;
  const auto change = [&](glm::dvec2 step) {
    return (handles.move(position + step).position - handles.move(position - step).position) /
           (2.0 * step_m);
  };
  const glm::dmat2 moved(change({step_m, 0.0}), change({0.0, step_m}));
  const double z = static_cast<double>(normal.z);
  const glm::dvec2 plan = glm::transpose(glm::inverse(moved)) * glm::dvec2(normal);
  return glm::vec3(glm::normalize(glm::dvec3(plan, z)));
}

glm::vec3 normal_at(const Dem& dem, glm::dvec2 position, double exaggeration) {
  const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
  const auto altitude = [&](double dx, double dy) {
    return static_cast<double>(sample_bilinear(dem.altitude_m, cell.x + dx, cell.y + dy));
  };
  const double rise = exaggeration / (2.0 * dem.cell_m());
  const double east = altitude(1.0, 0.0) - altitude(-1.0, 0.0);
  const double north = altitude(0.0, -1.0) - altitude(0.0, 1.0);
  return glm::vec3(glm::normalize(glm::dvec3(-east * rise, -north * rise, 1.0)));
}

// Whether a line of `step` lies between two altitudes, and whether it is a fifth one.
enum class Line { none, thin, thick };
Line line_between(float a, float b, double step) {
  if (std::isnan(a) || std::isnan(b)) return Line::none;
  const double low = std::floor(static_cast<double>(std::min(a, b)) / step);
  const double high = std::floor(static_cast<double>(std::max(a, b)) / step);
  if (low == high) return Line::none;
  return std::floor(low / 5.0) == std::floor(high / 5.0) ? Line::thin : Line::thick;
}

}  // namespace

RegisteredGround trace_registered(const RegisteredView& view) {
  const glm::ivec2 size_px = view.size_px();
  const Registration& registration = view.registration();
  const DisplacementField& field = view.deformation().field();
  const double focal_px =
      registration.scale * exact::exp(registration.view[view_unknown::log_focal]);
  RegisteredGround out{Grid<float>(size_px.x, size_px.y, unknown_value),
                       Grid<float>(size_px.x, size_px.y, unknown_value),
                       Grid<float>(size_px.x, size_px.y, unknown_value),
                       0,
                       Grid<glm::dvec2>(size_px.x, size_px.y),
                       Grid<glm::vec3>(size_px.x, size_px.y)};
  const MountainDeviation mountains(registration);
  const auto sigma_px = [&](glm::dvec2 position, double altitude_m) {
    const Displacement deviation = field.deviation(position);
    const double distance = view_distance_m(registration.frame, registration.view, position);
    const double of_field = exact::hypot(deviation.lateral_m, deviation.upward_m) *
                            std::numbers::sqrt2 / 2.0 * focal_px / distance;
    const double moved_px2 = mountains.variance_px2(position, altitude_m);
    return static_cast<float>(moved_px2 > 0.0 ? std::sqrt(of_field * of_field + moved_px2)
                                              : of_field);
  };
  // It changes slowly along the ground: one value for the pixels of a row that show neighbours.
  constexpr int run_px = 4;
  constexpr double neighbours = 1.01;  // ratio of their distances
  parallel_rows(size_px.y, [&](int y) {
    double distance = 0.0;
    for (int x = 0; x < size_px.x; ++x) {
      const std::optional<GeoPosition> at = view.map().to_geo({x + 0.5, y + 0.5});
      if (!at) continue;
      out.altitude_m(x, y) = static_cast<float>(at->altitude_m);
      out.distance_m(x, y) = static_cast<float>(at->distance_m);
      out.position(x, y) = at->position;
      const double exaggeration =
          view_exaggeration(registration.frame, registration.view,
                            view_distance_m(registration.frame, registration.view, at->position));
      out.normal(x, y) = carried(view.deformation().handles(), at->position,
                                 normal_at(view.dem(), at->position, exaggeration));
      const bool same =
          x % run_px != 0 && !std::isnan(out.sigma_px(x - 1, y)) &&
          std::max(at->distance_m, distance) < neighbours * std::min(at->distance_m, distance);
      out.sigma_px(x, y) = same ? out.sigma_px(x - 1, y) : sigma_px(at->position, at->altitude_m);
      if (!same) distance = at->distance_m;
    }
  });
  return out;
}

std::size_t folded_facets(const RegisteredView& view) {
  const Dem& dem = view.dem();
  const glm::ivec2 size = view.size_px();
  std::size_t count = 0;
  for (const Fold& fold : find_folds(dem.altitude_m, dem.transform, view.deformation())) {
    const double altitude = static_cast<double>(dem.altitude_m(fold.column, fold.row));
    const auto at = view.camera().project(view.deformation().point({fold.position, altitude}));
    count += at && at->x >= 0.0 && at->y >= 0.0 && at->x <= size.x && at->y <= size.y ? 1 : 0;
  }
  return count;
}

double contour_step_m(const Grid<float>& altitude_m) {
  std::vector<float> known;
  for (const float z : altitude_m)
    if (!std::isnan(z)) known.push_back(z);
  constexpr double smallest = 20.0, lines = 10.0;
  if (known.empty()) return smallest;
  const double relief = static_cast<double>(value_at_share(known, 0.95)) -
                        static_cast<double>(value_at_share(known, 0.05));
  double step = smallest;
  for (const double next : {50.0, 100.0, 200.0, 500.0})
    if (relief / next >= lines) step = next;
  return step;
}

Grid<glm::vec3> contours_over(const Grid<glm::vec3>& painting, const RegisteredGround& ground,
                              double step_m) {
  const glm::vec3 black(0.05F), white(1.F), red(0.95F, 0.1F, 0.1F), yellow(1.F, 0.85F, 0.1F);
  Grid<glm::vec3> out = painting;
  const auto draw = [&](int x, int y, glm::vec3 colour, float cover) {
    out(x, y) = glm::mix(out(x, y), colour, cover);
  };
  for (int y = 0; y + 1 < out.height(); ++y)
    for (int x = 0; x + 1 < out.width(); ++x) {
      const float z = ground.altitude_m(x, y);
      Line line = Line::none;
      bool skyline = false, silhouette = false;
      for (const glm::ivec2 to : {glm::ivec2(x + 1, y), glm::ivec2(x, y + 1)}) {
        const float other = ground.altitude_m(to.x, to.y);
        skyline = skyline || std::isnan(z) != std::isnan(other);
        const float near = std::min(ground.distance_m(x, y), ground.distance_m(to.x, to.y));
        const float far = std::max(ground.distance_m(x, y), ground.distance_m(to.x, to.y));
        const bool apart = far > silhouette_jump * near;
        silhouette = silhouette || apart;
        if (!apart) line = std::max(line, line_between(z, other, step_m));
      }
      if (line == Line::thin) draw(x, y, black, 0.45F);
      if (line == Line::thick) draw(x, y, white, 0.8F);
      if (silhouette) draw(x, y, yellow, 0.7F);
      if (skyline) draw(x, y, red, 1.F);
    }
  return out;
}

Grid<glm::vec3> trust_picture(const Grid<float>& sigma_px, double limit_px) {
  Grid<glm::vec3> out(sigma_px.width(), sigma_px.height(), glm::vec3(0.55F, 0.65F, 0.8F));
  const glm::vec3 good(0.93F, 0.95F, 0.88F), middle(0.95F, 0.75F, 0.3F), bad(0.55F, 0.1F, 0.15F);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (std::isnan(sigma_px[i])) continue;
    const float share = std::min(sigma_px[i] / static_cast<float>(limit_px), 1.F);
    out[i] = share < 0.5F ? glm::mix(good, middle, 2.F * share)
                          : glm::mix(middle, bad, 2.F * share - 1.F);
  }
  return out;
}

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
