#include "renderer/pipeline/view_judgement.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "base/error.h"
#include "base/math_exact.h"
#include "renderer/compose/ground_changes.h"
#include "renderer/compose/massifs.h"
#include "renderer/compose/view_reach.h"

namespace belvedere {
ViewEvaluation evaluate_view(const CoarseAltitudes& region, const View& view,
                             double widen_valleys_m) {
  ViewEvaluation out;
  const Projection* projection = find_projection(view.camera.projection);
  if (projection == nullptr || projection->widest_deg <= 0.0) {
    out.why_not = "a parallel projection has neither sky nor horizon";
    return out;
  }
  const Deformation deformation(view.deform, view.viewer_xy);
  const bool rearranged = !view.deform.summits.empty() || deformation.moves_in_plan();
  std::function<glm::dvec3(glm::dvec3)> move;
  if (rearranged) move = [&](glm::dvec3 p) { return deformation.rearranged(p); };
  CoarseGround ground;
  try {
    ground = coarse_ground_of(region, move);
    if (widen_valleys_m > 0.0) ground = widened_ground(ground, widen_valleys_m);
  } catch (const Error& problem) {
    out.why_not = problem.found();
    return out;
  }
  const Massifs massifs = find_massifs(ground);
  const CameraPicture picture(view.camera);
  const bool plane = view.camera.projection == "perspective";
  const double width = to_radians(view.camera.field_of_view_deg);
  const double shape = static_cast<double>(view.camera.height) / view.camera.width;
  SightModel sight{
      .picture = picture,
      .viewer = view.viewer_xy,
      .eye_m = view.camera.eye.z,
      .azimuth_deg = view.camera.azimuth_deg,
      .width = width,
      .height = plane ? 2.0 * exact::atan(exact::tan(0.5 * width) * shape) : width * shape,
      .directions = camera_directions(view.camera, MeasureParameters{}.columns),
      .distance_m = {},
      .drop_m = {},
      .exaggeration = {},
      .base_m = view.deform.exaggeration_base_m,
      .rim_fade_m = view.air.rim_fade_m,
      .air_from_m = view.air.from_m,
      .air_scale_m = view.air.scale_m,
      .haze = view.air.haze};
  const ViewReach reach = find_reach(ground, deformation, view.camera);
  sight.near_m = reach.near_m;
  sight.far_m = reach.far_m;
  if (!(sight.far_m > 0.0)) {
    out.why_not = "there are no data in the direction of the view";
    return out;
  }
  sight.distance_m = growing_distances(std::max(1.0, 0.5 * sight.near_m), 1.12 * sight.far_m,
                                       MeasureParameters{}.steps);
  for (const double d : sight.distance_m) {
    sight.drop_m.push_back(deformation.drop_m(d));
    sight.exaggeration.push_back(deformation.exaggeration(d));
  }
  const ViewMeasures measures = measure_view(ground, sight, massifs.anchors);
  ScoreContext context{
      .lone = massifs.lone, .plateau = ground.plateau, .main = -1, .anchors = massifs.anchors};
  const bool leads = std::any_of(measures.anchors.begin(), measures.anchors.end(),
                                 [](const AnchorSight& anchor) { return anchor.inside; });
  if (leads) context.main = leading_anchor(measures, context);
  out.terms = score_terms(measures, context);
  out.merit = merit(out.terms, context);
  out.subject = context.main < 0
                    ? "no mountain, canyon or shore as a main subject"
                    : describe_anchor(massifs.anchors[static_cast<std::size_t>(context.main)]);
  out.near_m = sight.near_m;
  out.far_m = sight.far_m;
  return out;
}

}  // namespace belvedere
