#include "terrain/deform/deform.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr double earth_radius_m = 6371.0e3;
constexpr double summit_ramp_m =
    200.0;  // height above its base over which a summit's factor is blended in

// 0 up to 0, h itself from the ramp's end on, smooth between: the cubic that starts with tangent 0
// and ends with 1.
double soft_height(double h) {
  if (h <= 0.0) return 0.0;
  if (h >= summit_ramp_m) return h;
  const double t = h / summit_ramp_m;
  return summit_ramp_m * t * t * (2.0 - t);
}

MonotoneCurve curve_of(const std::vector<ExaggerationPoint>& points) {
  std::vector<glm::dvec2> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0 && !(points[i].distance_m - points[i - 1].distance_m >= 1.0))
      throw Error(ErrorKind::usage, fmt::format("exaggeration_points.{}", i),
                  fmt::format("{} m after {} m", points[i].distance_m, points[i - 1].distance_m),
                  "distances in ascending order, at least 1 m apart");
    out.emplace_back(points[i].distance_m, points[i].factor);
  }
  return MonotoneCurve(std::move(out));
}

DisplacementField in_field(const DisplacementParameters& parameters) {
  try {
    return DisplacementField(parameters);
  } catch (const Error& error) {
    throw Error(error.kind(), "field." + error.where(), error.found(), error.allowed());
  }
}

}  // namespace

Deformation::Deformation(const DeformParameters& parameters, glm::dvec2 viewer_xy)
    : parameters_(parameters),
      viewer_xy_(viewer_xy),
      bend_(parameters.bend),
      handles_(parameters.handles),
      exaggeration_curve_(curve_of(parameters.exaggeration_points)),
      field_(in_field(parameters.field)) {}

double Deformation::distance_m(glm::dvec2 position) const {
  const double east = position.x - viewer_xy_.x;
  const double north = position.y - viewer_xy_.y;
  return std::sqrt(east * east + north * north);
}

double Deformation::drop_m(double distance_m) const {
  double drop = bend_.drop_m(distance_m);
  if (parameters_.earth_curvature) {
    // A ray bent down by refraction corresponds to an earth whose radius is larger by 1 / (1 - k).
    drop += distance_m * distance_m * (1.0 - parameters_.refraction) / (2.0 * earth_radius_m);
  }
  return drop;
}

double Deformation::exaggeration(double distance_m) const {
  const double near = parameters_.exaggeration;
  if (!parameters_.exaggeration_points.empty()) return near * exaggeration_curve_.at(distance_m);
  if (!parameters_.background_exaggeration || distance_m <= parameters_.foreground_to_m)
    return near;
  const double far = *parameters_.background_exaggeration;
  if (distance_m >= parameters_.background_from_m) return far;
  return near + (far - near) * smoothstep(parameters_.foreground_to_m,
                                          parameters_.background_from_m, distance_m);
}

double Deformation::raised_by_summits_m(glm::dvec3 point) const {
  double raised = 0.0;
  for (const SummitExaggeration& summit : parameters_.summits) {
    const double east = point.x - summit.centre.x;
    const double north = point.y - summit.centre.y;
    const double distance2 = east * east + north * north;
    if (distance2 >= summit.radius_m * summit.radius_m) continue;
    const double t = std::sqrt(distance2) / summit.radius_m;
    const double share = 1.0 - t * t * t * (10.0 + t * (6.0 * t - 15.0));
    raised += (summit.factor - 1.0) * share * soft_height(point.z - summit.base_m);
  }
  return raised;
}

HandleField::Moved Deformation::moved_by_handles(glm::dvec2 position) const {
  const glm::dvec2 low = handles_.lowest();
  const glm::dvec2 high = handles_.highest();
  if (handles_.is_identity() || position.x < low.x || position.y < low.y || position.x > high.x ||
      position.y > high.y)
    return {position, 0.0};
  return handles_.move(position);
}

glm::dvec2 Deformation::turned(glm::dvec2 position, double lateral_m) const {
  if (lateral_m == 0.0) return position;
  constexpr double nearest = 0.4;  // of the field's reach: nearer ground turns no further
  const double distance = std::max(distance_m(position), nearest * field_.parameters().reach_m);
  const exact::Turn turn = exact::turn(lateral_m / distance);
  const glm::dvec2 from = position - viewer_xy_;
  return viewer_xy_ + glm::dvec2(from.x * turn.cosine + from.y * turn.sine,
                                 from.y * turn.cosine - from.x * turn.sine);
}

glm::dvec2 Deformation::moved_in_plan(glm::dvec2 position) const {
  const glm::dvec2 moved = moved_by_handles(position).position;
  return field_.is_identity() ? moved : turned(moved, field_.at(position).lateral_m);
}

glm::dvec3 Deformation::rearranged(glm::dvec3 point) const {
  const double raised = parameters_.summits.empty() ? 0.0 : raised_by_summits_m(point);
  if (!moves_in_plan()) return {point.x, point.y, point.z + raised};
  const glm::dvec2 position(point);
  const HandleField::Moved moved = moved_by_handles(position);
  const double z = point.z + raised + moved.raise_m;
  if (field_.is_identity()) return {moved.position, z};
  const Displacement displaced = field_.at(position);
  return {turned(moved.position, displaced.lateral_m),
          z + displaced.upward_m / exaggeration(distance_m(moved.position))};
}

glm::dvec3 Deformation::unbent(glm::dvec3 point) const {
  const glm::dvec3 moved = rearranged(point);
  const double base = parameters_.exaggeration_base_m;
  return {moved.x, moved.y, base + (moved.z - base) * exaggeration(distance_m(glm::dvec2(moved)))};
}

glm::dvec3 Deformation::point(glm::dvec3 point) const {
  const glm::dvec3 moved = rearranged(point);
  const double base = parameters_.exaggeration_base_m;
  const double distance = distance_m(glm::dvec2(moved));
  return {moved.x, moved.y, base + (moved.z - base) * exaggeration(distance) - drop_m(distance)};
}

glm::dmat3 Deformation::shape_jacobian(glm::dvec3 point) const {
  const double e = exaggeration(distance_m(glm::dvec2(rearranged(point))));
  glm::dmat3 jacobian;
  constexpr double step_m =
      1.0;  // the functions are smooth over hundreds of metres, and double keeps nanometres
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 step(0.0);
    step[axis] = step_m;
    const glm::dvec3 change =
        (rearranged(point + step) - rearranged(point - step)) / (2.0 * step_m);
    jacobian[axis] = {change.x, change.y, e * change.z};
  }
  return jacobian;
}

std::optional<glm::dvec2> Deformation::source_of(glm::dvec2 moved) const {
  if (!moves_in_plan()) return moved;
  // Start from the current position and from the inverse of each handle: a moved core is far from
  // its origin.
  std::vector<glm::dvec2> starts = {moved};
  for (const DeformHandle& handle : handles_.handles()) {
    starts.push_back(moved - handle.move_m);
    starts.push_back(handle.centre);
  }
  constexpr double step_m = 0.5;
  constexpr double close_m = 1e-3;
  for (glm::dvec2 at : starts) {
    for (int round = 0; round < 40; ++round) {
      const glm::dvec2 error = moved_in_plan(at) - moved;
      if (glm::length(error) < close_m) return at;
      const auto change = [&](glm::dvec2 step) {
        return (moved_in_plan(at + step) - moved_in_plan(at - step)) / (2.0 * step_m);
      };
      const glm::dmat2 slope(change({step_m, 0.0}), change({0.0, step_m}));
      const double det = glm::determinant(slope);
      if (!(std::abs(det) > 1e-9)) break;
      at -= glm::inverse(slope) * error;
    }
  }
  return std::nullopt;
}

bool Deformation::is_local() const {
  return parameters_.background_exaggeration.has_value() ||
         !parameters_.exaggeration_points.empty() || !parameters_.summits.empty() ||
         moves_in_plan();
}

DeformedSurface deform(const Grid<float>& altitude_m, const GeoTransform& transform,
                       glm::dvec3 origin, const Deformation& deformation) {
  DeformedSurface surface{Grid<glm::vec3>(altitude_m.width(), altitude_m.height()), origin, {}};
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      const glm::dvec3 moved = deformation.point({transform.to_crs(x, y), altitude_m(x, y)});
      surface.vertices_m(x, y) = glm::vec3(moved - origin);
    }
  });
  return surface;
}

DeformedSurface deform(const Grid<float>& altitude_m, const GeoTransform& transform,
                       glm::dvec2 viewer_xy, glm::dvec3 origin,
                       const DeformParameters& parameters) {
  return deform(altitude_m, transform, origin, Deformation(parameters, viewer_xy));
}

void join_window(SurfaceWindow& window, const DeformedSurface& coarser) {
  const PixelRect& part = window.part;
  const auto join = [&](int x, int y) {
    window.surface.vertices_m(part.x0 + x, part.y0 + y) =
        coarser.vertices_m(window.replaces.x0 + x / 2, window.replaces.y0 + y / 2);
  };
  for (int x = 0; x < part.width(); ++x) join(x, 0), join(x, part.height() - 1);
  for (int y = 0; y < part.height(); ++y) join(0, y), join(part.width() - 1, y);
}

std::optional<glm::dvec3> undeform(const Deformation& deformation, glm::dvec3 deformed) {
  const DeformParameters& p = deformation.parameters();
  // Exaggeration and bend depend on the position after the handles.
  const glm::dvec2 from = glm::dvec2(deformed) - deformation.viewer_xy();
  const double distance_m = std::sqrt(from.x * from.x + from.y * from.y);
  const double moved_z = p.exaggeration_base_m +
                         (deformed.z + deformation.drop_m(distance_m) - p.exaggeration_base_m) /
                             deformation.exaggeration(distance_m);
  if (p.summits.empty() && !deformation.moves_in_plan())
    return glm::dvec3(deformed.x, deformed.y, moved_z);
  const std::optional<glm::dvec2> position = deformation.source_of(glm::dvec2(deformed));
  if (!position) return std::nullopt;
  // The height added by handles, field and summits now depends only on the altitude and grows with
  // it: secant method.
  const auto error = [&](double z) {
    return deformation.rearranged({position->x, position->y, z}).z - moved_z;
  };
  double z = moved_z;
  double off = error(z);
  double next = z - off;
  constexpr int rounds = 24;
  constexpr double close_m = 1e-3;
  for (int round = 0; round < rounds && std::abs(off) >= close_m; ++round) {
    const double next_off = error(next);
    const double slope = next_off - off;
    const double step = std::abs(slope) > 1e-12 ? next_off * (next - z) / slope : next_off;
    z = next;
    off = next_off;
    next = z - step;
  }
  return glm::dvec3(*position, z);
}

namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// Distance of a position from a handle's disc; 0 inside.
double distance_from(const DeformHandle& handle, glm::dvec2 position) {
  const double distance = glm::length(position - handle.centre);
  return handle.radius_m > 0.0 ? distance / handle.radius_m : distance * 1e-9;
}

}  // namespace

std::vector<Fold> find_folds(const Grid<float>& altitude_m, const GeoTransform& transform,
                             const Deformation& deformation) {
  if (!deformation.moves_in_plan() || altitude_m.width() < 2 || altitude_m.height() < 2) return {};
  const auto moved = [&](int x, int y) {
    const glm::dvec3 position = deformation.rearranged({transform.to_crs(x, y), altitude_m(x, y)});
    return glm::dvec2(position);
  };
  // Cells within the radius of some handle, and one more on each side; all if there is a field.
  const bool everywhere = !deformation.field().is_identity();
  const glm::dvec2 low = everywhere ? glm::dvec2(-1e9) : deformation.handles().lowest();
  const glm::dvec2 high = everywhere ? glm::dvec2(1e9) : deformation.handles().highest();
  const auto cell_of = [](double at, int count) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
  };
  const glm::dvec2 first = transform.to_cell(low.x, high.y);
  const glm::dvec2 last = transform.to_cell(high.x, low.y);
  const int x0 = cell_of(first.x - 1.0, altitude_m.width());
  const int y0 = cell_of(first.y - 1.0, altitude_m.height());
  const int x1 = cell_of(last.x + 1.0, altitude_m.width() - 1);
  const int y1 = cell_of(last.y + 1.0, altitude_m.height() - 1);
  if (y1 < y0 || x1 < x0) return {};

  std::vector<std::vector<Fold>> rows(static_cast<std::size_t>(y1 - y0 + 1));
  parallel_rows(static_cast<int>(rows.size()), [&](int row) {
    const int y = y0 + row;
    glm::dvec2 nw = moved(x0, y);
    glm::dvec2 sw = moved(x0, y + 1);
    for (int x = x0; x <= x1; ++x) {
      const glm::dvec2 ne = moved(x + 1, y);
      const glm::dvec2 se = moved(x + 1, y + 1);
      const auto add = [&](bool south_east, double at, glm::dvec2 sum) {
        rows[static_cast<std::size_t>(row)].push_back(
            {x, y, south_east, transform.to_crs(x + at, y + at), sum / 3.0});
      };
      // North is up in plan: (nw, sw, ne) and (se, ne, sw) run counter-clockwise as long as nothing
      // is folded.
      if (!(cross(sw - nw, ne - nw) > 0.0)) add(false, 1.0 / 3.0, nw + sw + ne);
      if (!(cross(ne - se, sw - se) > 0.0)) add(true, 2.0 / 3.0, se + ne + sw);
      nw = ne;
      sw = se;
    }
  });
  std::vector<Fold> folds;
  for (const std::vector<Fold>& row : rows) folds.insert(folds.end(), row.begin(), row.end());
  return folds;
}

std::vector<FoldSummary> summarize_folds(const std::vector<Fold>& folds,
                                         const DeformParameters& deform) {
  const std::vector<DeformHandle>& handles = deform.handles;
  const double limit = deform.field.places.empty() ? std::numeric_limits<double>::infinity() : 1.0;
  // The last is for folds that lie in no handle.
  std::vector<std::vector<const Fold*>> of_handle(handles.size() + 1);
  for (const Fold& fold : folds) {
    std::size_t nearest = handles.size();
    double nearest_distance = limit;
    for (std::size_t i = 0; i < handles.size(); ++i) {
      const double distance = distance_from(handles[i], fold.position);
      if (distance <= nearest_distance) nearest = i, nearest_distance = distance;
    }
    of_handle[nearest].push_back(&fold);
  }
  std::vector<FoldSummary> summaries;
  for (std::size_t i = 0; i < of_handle.size(); ++i) {
    if (of_handle[i].empty()) continue;
    glm::dvec2 mean(0.0);
    for (const Fold* fold : of_handle[i])
      mean += fold->position / static_cast<double>(of_handle[i].size());
    // The mean of a ring of folds has no fold itself.
    const Fold* centre = *std::min_element(
        of_handle[i].begin(), of_handle[i].end(), [&](const Fold* a, const Fold* b) {
          return glm::length(a->position - mean) < glm::length(b->position - mean);
        });
    summaries.push_back({i < handles.size() ? std::optional(i) : std::nullopt, of_handle[i].size(),
                         centre->position});
  }
  return summaries;
}

}  // namespace belvedere
