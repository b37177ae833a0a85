#include "renderer/compose/view_reach.h"

#include <algorithm>

#include "base/statistics.h"
#include "renderer/compose/view_layout.h"
#include "renderer/compose/view_measures.h"

namespace belvedere {
namespace {

// Two fifths of the ground with data between two distances in view, or of all of it, are lower.
double level_of(const CoarseGround& ground, const CameraParameters& camera, glm::dvec2 viewer,
                double near_m, double far_m) {
  std::vector<float> altitudes;
  if (far_m > near_m) {
    ViewShape view;
    view.viewer = viewer;
    view.azimuth_deg = camera.azimuth_deg;
    view.field_of_view_deg = camera.field_of_view_deg;
    view.near_m = near_m;
    view.far_m = far_m;
    for (const WedgePoint& p : wedge_points(view))
      if (const GroundCell* c = ground.at(p.position); c != nullptr && c->known)
        altitudes.push_back(c->altitude_m);
  }
  constexpr std::size_t fewest = 40;
  if (altitudes.size() < fewest) {
    altitudes.clear();
    for (const GroundCell& c : ground.cells)
      if (c.known) altitudes.push_back(c.altitude_m);
  }
  return static_cast<double>(value_at_rank(altitudes, altitudes.size() * 2 / 5));
}

// The farthest ground, at the centre of the directions.
double farthest_m(const CoarseGround& ground, const std::vector<glm::dvec2>& directions,
                  glm::dvec2 viewer, double azimuth_deg) {
  constexpr int steps = 400;
  std::vector<double> reach;
  for (const glm::dvec2& direction : directions) {
    double last = 0.0;
    for (int k = 1; k <= steps; ++k) {
      const double d = 3.0 * ground.side_m * k / steps;
      const GroundCell* c = ground.at(viewer + d * to_map(direction, azimuth_deg));
      if (c != nullptr && c->known) last = d;
    }
    reach.push_back(last);
  }
  std::sort(reach.begin(), reach.end());
  return reach.empty() ? 0.0 : reach[reach.size() / 2];
}

}  // namespace

CameraPicture::CameraPicture(const CameraParameters& parameters)
    : camera_(make_camera(parameters)), azimuth_deg_(parameters.azimuth_deg) {}

glm::dvec2 CameraPicture::position(glm::dvec2 direction, double depression) const {
  constexpr double away_m = 10000.0;
  const glm::dvec2 on_map = to_map(direction, azimuth_deg_);
  const auto at = camera_->project(camera_->eye() + away_m * glm::dvec3(on_map, -depression));
  if (!at) return {0.5 + 1e6 * direction.x, 1e6};
  return *at / glm::dvec2(camera_->size());
}

std::vector<glm::dvec2> camera_directions(const CameraParameters& camera, int columns) {
  return fan_directions(camera.field_of_view_deg, camera.projection != "perspective", columns);
}

ViewReach find_reach(const CoarseGround& ground, const Deformation& deformation,
                     const CameraParameters& camera) {
  const glm::dvec2 viewer = deformation.viewer_xy();
  const std::vector<glm::dvec2> directions = camera_directions(camera, MeasureParameters{}.columns);
  const double farthest = farthest_m(ground, directions, viewer, camera.azimuth_deg);
  if (farthest <= 0.0) return {};
  // Parallel lines of sight have no horizon: such a view ends where the data do.
  const Projection* projection = find_projection(camera.projection);
  if (projection == nullptr || projection->widest_deg <= 0.0) return {0.5 * farthest, farthest};

  const CameraPicture picture(camera);
  const double base = deformation.parameters().exaggeration_base_m;
  const double smallest = std::max(10.0, 0.001 * ground.side_m);
  ViewReach reach;
  // The horizon determines which ground is in view, and that ground the level of the horizon.
  for (int round = 0; round < 2; ++round) {
    const double level_m = level_of(ground, camera, viewer, reach.near_m, reach.far_m);
    const auto depression = [&](double d) {
      const double z = base + deformation.exaggeration(d) * (level_m - base);
      return (camera.eye.z - z + deformation.drop_m(d)) / d;
    };
    constexpr int steps = 600;
    const std::vector<double> distances =
        growing_distances(smallest, std::max(2.0 * smallest, farthest), steps);
    reach = {0.0, farthest};
    std::size_t highest = 0;
    for (std::size_t i = 0; i < distances.size(); ++i) {
      const double t = depression(distances[i]);
      if (reach.near_m == 0.0 && picture.position({0.0, 1.0}, t).y <= 1.0)
        reach.near_m = distances[i];
      if (t < depression(distances[highest])) highest = i;
    }
    // Interpolated between its neighbours, in thirds.
    double from = distances[highest == 0 ? 0 : highest - 1];
    double to = distances[std::min(highest + 1, distances.size() - 1)];
    for (int third = 0; third < 40; ++third) {
      const double a = from + (to - from) / 3.0, b = to - (to - from) / 3.0;
      (depression(a) <= depression(b) ? to : from) = depression(a) <= depression(b) ? b : a;
    }
    reach.far_m = 0.5 * (from + to);
    if (reach.near_m == 0.0 || reach.near_m > 0.98 * reach.far_m) reach.near_m = 0.5 * reach.far_m;
  }
  return reach;
}

}  // namespace belvedere
