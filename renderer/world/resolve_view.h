#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/view_candidates.h"
#include "renderer/compose/view_shape.h"
#include "renderer/paint/air.h"
#include "renderer/scene/scene.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/light_field.h"
#include "renderer/world/lazy_value.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"

namespace belvedere {

// A value of a view that its scene leaves open, as it could be written.
struct DerivedValue {
  std::string key;  // dotted
  std::string value;
  std::string why;
};

// Distances between which generalization changes from the foreground's to the background's.
struct GeneralizeDistances {
  double foreground_to_m = 32000.0;
  double background_from_m = 90000.0;
};

// Values derived from the distance of a view's horizon.
struct ViewDistances {
  AirParameters air;
  GeneralizeDistances generalize;
};

// Derives values that a scene leaves open from its region, by the rules that propose views
// (renderer/compose). Given values are unchanged, and derived ones are rounded to what one would
// write: a scene that writes them has the same picture. Each step adds its findings to `derived`.
// Where nothing can be found (no ground in view), the ground is neither raised nor bent and
// distances are those of the Alps.

// The ground in coarse cells, computed when it is first needed; nothing where no altitude is known.
std::optional<CoarseGround> region_of(const CoarseAltitudes& altitudes);
using LazyRegion = LazyValue<std::optional<CoarseGround>>;

// The look_at point of a scene.
struct ViewTarget {
  glm::dvec2 position{0.0};
  double altitude_m = 0.0;
};
struct ViewPosition {
  glm::dvec2 viewer{0.0};
  std::optional<double> ground_m;    // below the viewer, if known
  std::optional<ViewTarget> target;  // without it the view is given by azimuth and pitch
};

struct ResolvedView {
  SceneCamera camera;               // with its height; without a target with azimuth and pitch
  SceneDeform deform;               // with exaggeration and bend
  std::optional<double> pitch_deg;  // of a view with a target, produced by tilt
  double max_tilt_deg = 0.0;        // at which the target stays in the picture
};
ResolvedView resolve_view(const Scene& scene, const ViewPosition& position,
                          const LazyRegion& region, std::vector<DerivedValue>& derived);

// The tilt of a view whose pitch without it is `pitch_deg`.
double resolve_tilt(const SceneCamera& camera, const ResolvedView& resolved, double pitch_deg,
                    std::vector<DerivedValue>& derived);

SunPosition resolve_sun(const SceneSun& sun, double view_azimuth_deg,
                        std::vector<DerivedValue>& derived);

// Derives air and distances of generalization from the horizon of the view.
ViewDistances resolve_distances(const Scene& scene, const Deformation& deformation,
                                const CameraParameters& camera, const LazyRegion& region,
                                std::vector<DerivedValue>& derived);

// A partly specified view.
struct GivenView {
  glm::dvec2 viewer{0.0};
  std::optional<double> azimuth_deg;  // without it the best of 24 directions
  double field_of_view_deg = 44.0;
  double aspect = 2.0;
  bool cylinder = false;
  LayoutGiven resolved;
};
// Completes a view: the horizon as far away as the data allow, then the layout of proposals.
// Nothing where there are no data in that direction.
std::optional<ViewShape> complete_view(const CoarseGround& ground, const GivenView& given);

}  // namespace belvedere
