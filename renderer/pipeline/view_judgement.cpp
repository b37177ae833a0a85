#include "renderer/pipeline/view_judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/angle.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "renderer/compose/massifs.h"
#include "renderer/trace/camera.h"

namespace belvedere {
namespace {

// A camera's own picture, whatever its projection.
class CameraPicture final : public PictureMap {
 public:
  explicit CameraPicture(const CameraParameters& parameters) : camera_(make_camera(parameters)), azimuth_deg_(parameters.azimuth_deg) {}
  glm::dvec2 place(glm::dvec2 direction, double depression) const override {
    constexpr double away_m = 10000.0;
    const glm::dvec2 on_map = to_map(direction, azimuth_deg_);
    const auto at = camera_->project(camera_->eye() + away_m * glm::dvec3(on_map, -depression));
    if (!at) return {0.5 + 1e6 * direction.x, 1e6};
    return *at / glm::dvec2(camera_->size());
  }

 private:
  std::unique_ptr<Camera> camera_;
  double azimuth_deg_;
};

// Heights of level ground of the region, seen from the eye: where it enters the picture, and where it is highest in it.
void find_near_and_far(const CoarseGround& ground, const Deformation& deformation, double level_m, SightModel& sight) {
  const double base = deformation.parameters().exaggeration_base_m;
  const auto depression = [&](double d) {
    const double z = base + deformation.exaggeration(d) * (level_m - base);
    return (sight.eye_m - z + deformation.drop_m(d)) / d;
  };
  // The farthest ground there is in view, but for a twentieth.
  double farthest = 0.0;
  constexpr int steps = 400;
  std::vector<double> reach;
  for (const glm::dvec2& direction : sight.directions) {
    double last = 0.0;
    for (int k = 1; k <= steps; ++k) {
      const double d = 3.0 * ground.side_m * k / steps;
      const GroundCell* c = ground.at(sight.viewer + d * to_map(direction, sight.azimuth_deg));
      if (c != nullptr && c->known) last = d;
    }
    reach.push_back(last);
  }
  std::sort(reach.begin(), reach.end());
  farthest = reach.empty() ? 0.0 : reach[reach.size() / 2];
  const double smallest = std::max(10.0, 0.001 * ground.side_m);
  double lowest = 1e9;
  sight.near_m = 0.0;
  sight.far_m = farthest;
  for (const double d : growing_distances(smallest, std::max(2.0 * smallest, farthest), 600)) {
    const double t = depression(d);
    if (sight.near_m == 0.0 && sight.picture.place({0.0, 1.0}, t).y <= 1.0) sight.near_m = d;
    if (t < lowest) lowest = t, sight.far_m = d;
  }
  if (sight.near_m == 0.0 || sight.near_m > 0.98 * sight.far_m) sight.near_m = 0.5 * sight.far_m;
}

}  // namespace

ViewJudgement judge_view(const Dem& dem, const View& view, const AirParameters& air) {
  ViewJudgement out;
  const Projection* projection = find_projection(view.camera.projection);
  if (projection == nullptr || projection->widest_deg <= 0.0) {
    out.why_not = "a parallel projection has neither sky nor horizon";
    return out;
  }
  const Deformation deformation(view.deform, view.viewer_xy);
  const bool rearranged = !view.deform.summits.empty() || !view.deform.handles.empty();
  std::function<glm::dvec3(glm::dvec3)> move;
  if (rearranged) move = [&](glm::dvec3 p) { return deformation.rearranged(p); };
  CoarseGround ground;
  try {
    ground = coarse_ground_of(dem, {}, move);
  } catch (const Error& problem) {
    out.why_not = problem.found();
    return out;
  }
  const Massifs massifs = find_massifs(ground);
  const CameraPicture picture(view.camera);
  const bool plane = view.camera.projection == "perspective";
  const double width = to_radians(view.camera.field_of_view_deg);
  const double shape = static_cast<double>(view.camera.height) / view.camera.width;
  SightModel sight{.picture = picture,
                   .viewer = view.viewer_xy,
                   .eye_m = view.camera.eye.z,
                   .azimuth_deg = view.camera.azimuth_deg,
                   .width = width,
                   .height = plane ? 2.0 * exact::atan(exact::tan(0.5 * width) * shape) : width * shape,
                   .directions = fan_directions(view.camera.field_of_view_deg, !plane, MeasureParameters{}.columns),
                   .distance_m = {},
                   .drop_m = {},
                   .exaggeration = {},
                   .base_m = view.deform.exaggeration_base_m,
                   .rim_fade_m = air.rim_fade_m,
                   .air_from_m = air.from_m,
                   .air_scale_m = air.scale_m,
                   .haze = air.haze};
  // Level ground as layouts take it: two fifths of the region lie lower.
  std::vector<float> known;
  for (const GroundCell& c : ground.cells)
    if (c.known) known.push_back(c.altitude_m);
  std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() * 2 / 5), known.end());
  find_near_and_far(ground, deformation, static_cast<double>(known[known.size() * 2 / 5]), sight);
  if (!(sight.far_m > 0.0)) {
    out.why_not = "no data lie in the direction of the view";
    return out;
  }
  sight.distance_m = growing_distances(std::max(1.0, 0.5 * sight.near_m), 1.12 * sight.far_m, MeasureParameters{}.steps);
  for (const double d : sight.distance_m) {
    sight.drop_m.push_back(deformation.drop_m(d));
    sight.exaggeration.push_back(deformation.exaggeration(d));
  }
  const ViewMeasures measures = measure_view(ground, sight, massifs.anchors);
  ScoreContext context{.lone = massifs.lone, .plateau = ground.plateau, .main = -1, .anchors = massifs.anchors};
  const bool leads = std::any_of(measures.anchors.begin(), measures.anchors.end(), [](const AnchorSight& anchor) { return anchor.inside; });
  if (leads) context.main = leading_anchor(measures, context);
  out.terms = score_terms(measures, context);
  out.merit = merit(out.terms, context);
  out.subject = context.main < 0 ? "no mountain, canyon or shore that leads"
                                 : describe_anchor(massifs.anchors[static_cast<std::size_t>(context.main)]);
  out.near_m = sight.near_m;
  out.far_m = sight.far_m;
  return out;
}

}  // namespace belvedere
