#include "renderer/world/resolve_view.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "renderer/compose/massifs.h"
#include "renderer/compose/view_measures.h"
#include "renderer/compose/view_score.h"

namespace belvedere {
namespace {

constexpr double crest_share = 0.80;  // of the horizon's distance, for the first try of views

// How far the data extend in the directions of a view: the median.
double reach_m(const CoarseGround& ground, const ViewShape& view) {
  constexpr int columns = 25, steps = 300;
  std::vector<double> reach;
  for (const glm::dvec2 direction :
       fan_directions(view.field_of_view_deg, view.cylinder, columns)) {
    const glm::dvec2 on_map = to_map(direction, view.azimuth_deg);
    double last = 0.0;
    for (int k = 1; k <= steps; ++k) {
      const double distance = 3.0 * ground.side_m * k / steps;
      const GroundCell* c = ground.at(view.viewer + distance * on_map);
      if (c != nullptr && c->known) last = distance;
    }
    reach.push_back(last);
  }
  std::sort(reach.begin(), reach.end());
  return reach[reach.size() / 2];
}

void set_distances(ViewShape& view, double far_m, double near_share) {
  view.far_m = far_m;
  view.near_m = near_share * far_m;
  view.crest_m = crest_share * far_m;
}

// The largest view that the data fill; if none does, one to the end of the data.
bool choose_distances(const CoarseGround& ground, ViewShape& view) {
  const FormatLimits limits = limits_of({view.aspect, view.field_of_view_deg >= 359.0});
  // For a viewer far outside, the data begin at some distance; for one inside, they may end close
  // by.
  const std::array near_shares = {limits.near_share, 0.5 * (limits.near_share + limits.max_near),
                                  limits.max_near, limits.min_near};
  constexpr int sizes = 24;
  constexpr double largest = 1.9, smallest = 0.25;  // of the side
  const std::vector<double> shares = growing_distances(smallest, largest, sizes);
  for (int s = sizes; s-- > 0;)
    for (const double near_share : near_shares) {
      set_distances(view, shares[static_cast<std::size_t>(s)] * ground.side_m, near_share);
      if (fits_data(ground, view)) return true;
    }
  const double reach = reach_m(ground, view);
  if (reach <= 0.0) return false;
  set_distances(view, reach, limits.near_share);
  return true;
}

std::optional<ViewShape> complete(const CoarseGround& ground, const GivenView& given,
                                  double azimuth_deg, double lone) {
  ViewShape view;
  view.viewer = given.viewer;
  view.azimuth_deg = azimuth_deg;
  view.field_of_view_deg = given.field_of_view_deg;
  view.aspect = given.aspect;
  view.cylinder = given.cylinder;
  if (!choose_distances(ground, view)) return std::nullopt;
  return lay_out(ground, view, lone, {}, given.resolved);
}

}  // namespace

std::optional<ViewShape> complete_view(const CoarseGround& ground, const GivenView& given) {
  const Massifs massifs = find_massifs(ground);
  if (given.azimuth_deg) return complete(ground, given, *given.azimuth_deg, massifs.lone);
  constexpr int directions = 24;
  constexpr MeasureParameters quick{.columns = 61, .steps = 130};
  std::optional<ViewShape> best;
  double max = 0.0;
  for (int k = 0; k < directions; ++k) {
    const std::optional<ViewShape> view =
        complete(ground, given, 360.0 * k / directions, massifs.lone);
    if (!view) continue;
    const ViewMeasures measures = measure_view(ground, *view, massifs.anchors, quick);
    ScoreContext context{
        .lone = massifs.lone, .plateau = ground.plateau, .main = -1, .anchors = massifs.anchors};
    // A direction with a leading subject is preferred to one without.
    constexpr double leads = 100.0;
    double score = 0.0;
    if (std::any_of(measures.anchors.begin(), measures.anchors.end(),
                    [](const AnchorSight& a) { return a.inside; })) {
      context.main = leading_anchor(measures, context);
      score = leads;
    }
    score += total(score_terms(measures, context));
    if (!best || score > max) best = view, max = score;
  }
  return best;
}

namespace {

// Height of viewers with parallel lines of sight, and where no ground is in view.
constexpr double plain_height_m = 3000.0;

bool is_parallel(const SceneCamera& camera) {
  const Projection* projection = find_projection(camera.projection);
  return projection == nullptr || projection->widest_deg <= 0.0;
}

// Which values of a scene are to be found.
struct Open {
  bool exaggeration, base, bend, height, azimuth, pitch, tilt;
  bool any() const { return exaggeration || bend || height || azimuth || pitch || tilt; }
};

Open open_of(const Scene& scene, bool has_target) {
  const SceneCamera& camera = scene.camera;
  const SceneDeform& deform = scene.deform;
  const BendCurve& bend = deform.ground.bend;
  if (is_parallel(camera)) return {};
  return {.exaggeration = !deform.exaggeration,
          .base = !deform.exaggeration && !deform.exaggeration_base_m,
          .bend = !deform.bend_radius_m && !deform.bend_crest_m && bend.points.empty() &&
                  bend.far_amount_per_m == 0.0,
          .height = !camera.height_m && !camera.height_above_ground,
          .azimuth = !has_target && !camera.azimuth_deg,
          .pitch = !has_target && !camera.pitch_deg,
          .tilt = has_target && !camera.tilt_deg};
}

// Values that the layout must keep.
GivenView given_view(const Scene& scene, const ViewPosition& position, const Open& open) {
  const SceneCamera& camera = scene.camera;
  GivenView given;
  given.viewer = position.viewer;
  given.field_of_view_deg = camera.field_of_view_deg;
  given.aspect = static_cast<double>(scene.output.width) / scene.output.height;
  given.cylinder = camera.projection != "perspective";
  if (position.target) {
    const glm::dvec2 away = position.target->position - position.viewer;
    given.azimuth_deg = to_degrees(exact::atan2(away.x, away.y));
  } else {
    given.azimuth_deg = camera.azimuth_deg;
  }
  LayoutGiven& resolved = given.resolved;
  resolved.exaggeration = scene.deform.exaggeration;
  resolved.base_m =
      open.base ? std::nullopt : std::optional(scene.deform.written().exaggeration_base_m);
  if (!open.bend) {
    DeformParameters bend = scene.deform.written();
    bend.summits.clear();
    resolved.drop_m = [deformation = Deformation(bend, position.viewer)](double distance) {
      return deformation.drop_m(distance);
    };
  }
  if (!open.height) {
    const double height = camera.height_m.value_or(plain_height_m);
    const bool above = camera.height_above_ground && position.ground_m.has_value();
    const double ground_m = position.ground_m.value_or(0.0);
    resolved.eye_m = [=](const ViewShape& view) {
      return above ? view.raised_m(ground_m) + height : height;
    };
  }
  const double tilt = camera.tilt_deg.value_or(0.0);
  if (position.target && !open.tilt) {
    const ViewTarget target = *position.target;
    const double distance = glm::length(target.position - position.viewer);
    resolved.pitch_deg = [=](const ViewShape& view) {
      return to_degrees(exact::atan2(view.raised_m(target.altitude_m) - view.eye_m, distance)) +
             tilt;
    };
  } else if (!position.target && camera.pitch_deg) {
    resolved.pitch_deg = [pitch = *camera.pitch_deg + tilt](const ViewShape&) { return pitch; };
  }
  return given;
}

// An exaggeration that keeps a given viewpoint above the ground.
double below_the_eye(double exaggeration, const ViewShape& view, const ViewPosition& position) {
  constexpr double min_over_m = 50.0;
  if (!position.ground_m || *position.ground_m <= view.base_m) return exaggeration;
  const double max = (view.eye_m - min_over_m - view.base_m) / (*position.ground_m - view.base_m);
  return std::max(std::min(exaggeration, std::floor(100.0 * max) / 100.0), 1.0);
}

class Derived {
 public:
  explicit Derived(std::vector<DerivedValue>& list) : list_(list) {}
  // Adds a value, and returns it.
  double operator()(const char* key, double value, std::string why) {
    list_.push_back({key, fmt::format("{}", value), std::move(why)});
    return value;
  }

 private:
  std::vector<DerivedValue>& list_;
};

void settle_plain(ResolvedView& resolved) {
  SceneCamera& camera = resolved.camera;
  camera.height_m = camera.height_m.value_or(plain_height_m);
  camera.azimuth_deg = camera.azimuth_deg.value_or(CameraParameters{}.azimuth_deg);
  camera.pitch_deg = camera.pitch_deg.value_or(CameraParameters{}.pitch_deg);
}

}  // namespace

std::optional<CoarseGround> region_of(const CoarseAltitudes& altitudes) {
  const Grid<float>& blocks = altitudes.blocks.cells;
  // Single cells without any block with data are not a region.
  if (std::all_of(blocks.begin(), blocks.end(), [](float z) { return std::isnan(z); }))
    return std::nullopt;
  try {
    return coarse_ground_of(altitudes);
  } catch (const Error&) {  // too few data
    return std::nullopt;
  }
}

ResolvedView resolve_view(const Scene& scene, const ViewPosition& position,
                          const LazyRegion& region, std::vector<DerivedValue>& derived) {
  ResolvedView resolved{.camera = scene.camera, .deform = scene.deform, .pitch_deg = {}};
  const Open open = open_of(scene, position.target.has_value());
  std::optional<ViewShape> found;
  if (open.any() && region.get())
    found = complete_view(*region.get(), given_view(scene, position, open));
  if (!found) {
    settle_plain(resolved);
    return resolved;
  }
  const ViewShape& view = *found;
  // A given viewpoint below the ground is an error of the scene, which a bend cannot correct.
  const double raise =
      open.exaggeration ? below_the_eye(view.exaggeration, view, position) : view.exaggeration;
  if (!open.height && position.ground_m &&
      view.eye_m < view.base_m + raise * (*position.ground_m - view.base_m)) {
    settle_plain(resolved);
    return resolved;
  }
  Derived derive(derived);
  const std::string horizon = fmt::format("{:.1f} km", view.far_m / 1000.0);
  if (open.exaggeration) {
    const double wanted = rounded_to(view.exaggeration, 100.0);
    resolved.deform.exaggeration =
        derive("deform.exaggeration", open.height ? wanted : below_the_eye(wanted, view, position),
               "so that forms in the middle distance are as tall as in painted panoramas");
  }
  if (open.base)
    resolved.deform.exaggeration_base_m =
        derive("deform.exaggeration_base_m", std::round(view.base_m),
               "a tenth of the ground in view is lower");
  if (open.bend) {
    constexpr double min_m = 1000.0;
    resolved.deform.bend_radius_m =
        derive("deform.bend.radius_m", std::max(rounded_m(view.radius_m), min_m),
               "so that the horizon is at " + horizon);
    resolved.deform.bend_crest_m =
        derive("deform.bend.crest_m", rounded_m(view.crest_m), "0.8 of that");
  }
  if (open.height) {
    constexpr double min_over_m = 100.0;
    const double ground_m =
        position.ground_m ? view.raised_m(*position.ground_m) + min_over_m : view.eye_m;
    resolved.camera.height_m =
        derive("camera.height_m", std::round(std::max(view.eye_m, ground_m)),
               "so that the line of sight touches the bent level ground at " + horizon);
  }
  if (open.azimuth)
    resolved.camera.azimuth_deg =
        derive("camera.azimuth_deg", rounded_to(turned_deg(view.azimuth_deg), 10.0),
               "of 24 directions the one that shows most");
  if (open.pitch)
    resolved.camera.pitch_deg = derive(
        "camera.pitch_deg", rounded_to(view.pitch_deg - scene.camera.tilt_deg.value_or(0.0), 100.0),
        "an eighth of the picture is sky");
  constexpr double off_centre = 0.38;  // of the picture's height
  if (open.tilt) {
    resolved.pitch_deg = view.pitch_deg;
    resolved.max_tilt_deg = std::min(off_centre * to_degrees(picture_height(view)), 45.0);
  }
  settle_plain(resolved);
  return resolved;
}

double resolve_tilt(const SceneCamera& camera, const ResolvedView& resolved, double pitch_deg,
                    std::vector<DerivedValue>& derived) {
  if (!resolved.pitch_deg) return camera.tilt_deg.value_or(0.0);
  const double wanted = *resolved.pitch_deg - pitch_deg;
  const bool less = std::abs(wanted) > resolved.max_tilt_deg;
  return Derived(derived)(
      "camera.tilt_deg",
      rounded_to(std::clamp(wanted, -resolved.max_tilt_deg, resolved.max_tilt_deg), 100.0),
      less ? "as far as the point looked at stays in the picture"
           : "an eighth of the picture is sky");
}

SunPosition resolve_sun(const SceneSun& sun, double view_azimuth_deg,
                        std::vector<DerivedValue>& derived) {
  const PainterSun painter = painter_sun(view_azimuth_deg);
  Derived derive(derived);
  SunPosition out;
  out.azimuth_deg = sun.azimuth_deg ? *sun.azimuth_deg
                                    : derive("sun.azimuth_deg", std::round(painter.azimuth_deg),
                                             "from the upper left of the picture");
  out.altitude_deg = sun.altitude_deg ? *sun.altitude_deg
                                      : derive("sun.altitude_deg", painter.altitude_deg,
                                               "as in painted panoramas");
  return out;
}

ViewDistances resolve_distances(const Scene& scene, const Deformation& deformation,
                                const CameraParameters& camera, const LazyRegion& region,
                                std::vector<DerivedValue>& derived) {
  ViewDistances out;
  const SceneAir& air = scene.air;
  const SceneGeneralize& bands = scene.generalize;
  const AirParameters plain;
  out.air = air.look;
  out.air.from_m = air.from_m.value_or(plain.from_m);
  out.air.scale_m = air.scale_m.value_or(plain.scale_m);
  out.air.rim_fade_m = air.rim_fade_m.value_or(plain.rim_fade_m);
  if (bands.foreground_to_m) out.generalize.foreground_to_m = *bands.foreground_to_m;
  if (bands.background_from_m) out.generalize.background_from_m = *bands.background_from_m;
  const bool all = air.from_m && air.scale_m && air.rim_fade_m && bands.foreground_to_m &&
                   bands.background_from_m;
  if (all || !region.get()) return out;
  const double far_m = find_reach(*region.get(), deformation, camera).far_m;
  if (far_m <= 0.0) return out;
  const HorizonDefaults found = defaults_of_horizon(far_m);
  Derived derive(derived);
  const std::string horizon =
      fmt::format("of the distance of the horizon, {:.1f} km", far_m / 1000.0);
  // If one distance is given, the other is kept beyond it.
  constexpr double apart = 1.5;
  if (!bands.foreground_to_m) {
    const double max =
        bands.background_from_m ? *bands.background_from_m / apart : found.foreground_to_m;
    out.generalize.foreground_to_m =
        derive("generalize.foreground_to_m", rounded_m(std::min(found.foreground_to_m, max)),
               ".42 " + horizon);
  }
  if (!bands.background_from_m) {
    const double min =
        bands.foreground_to_m ? *bands.foreground_to_m * apart : found.background_from_m;
    out.generalize.background_from_m =
        derive("generalize.background_from_m",
               std::max(rounded_m(std::max(found.background_from_m, min)), 1.0), ".95 " + horizon);
  }
  if (!air.from_m)
    out.air.from_m = derive("air.from_m", rounded_m(found.air_from_m), ".45 " + horizon);
  if (!air.scale_m)
    out.air.scale_m =
        derive("air.scale_m", std::max(rounded_m(found.air_scale_m), 1.0), ".6 " + horizon);
  if (!air.rim_fade_m)
    out.air.rim_fade_m = derive("air.rim_fade_m", rounded_m(found.rim_fade_m), ".035 " + horizon);
  return out;
}

}  // namespace belvedere
