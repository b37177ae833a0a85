#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "renderer/compose/coarse_ground.h"
#include "renderer/scene/scene.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/sun.h"
#include "renderer/world/derived_values.h"
#include "renderer/world/lazy_value.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"

namespace belvedere {

// What a scene does not say follows from its region, by the rules that views are proposed by (renderer/compose). What it says stays as it
// is, and what is found is rounded to what one would write: a scene that writes it has the same picture. Each step adds what it found to
// `derived`. Where nothing can be found (no ground in view), the ground is neither raised nor bent and distances are those of the Alps.

// The ground in coarse cells, looked at when it is first needed; nothing where no altitude is known.
std::optional<CoarseGround> region_of(const CoarseAltitudes& altitudes);
using LazyRegion = LazyValue<std::optional<CoarseGround>>;

// The point that a scene looks at.
struct ViewTarget {
  glm::dvec2 place{0.0};
  double altitude_m = 0.0;
};
struct ViewPlace {
  glm::dvec2 viewer{0.0};
  std::optional<double> ground_m;    // under the viewer, where it is known
  std::optional<ViewTarget> target;  // without it the view goes by azimuth and pitch
};

struct SettledView {
  SceneCamera camera;               // with its height; without a target with azimuth and pitch
  SceneDeform deform;               // with exaggeration and bend
  std::optional<double> pitch_deg;  // found for a view with a target, whose tilt brings it there …
  double most_tilt_deg = 0.0;       // … as far as the target stays in the picture
};
SettledView settle_view(const Scene& scene, const ViewPlace& place, const LazyRegion& region, std::vector<DerivedValue>& derived);

// The tilt of a view whose pitch is `pitch_deg` without it.
double settle_tilt(const SceneCamera& camera, const SettledView& settled, double pitch_deg, std::vector<DerivedValue>& derived);

SunPosition settle_sun(const SceneSun& sun, double view_azimuth_deg, std::vector<DerivedValue>& derived);

// Air and distances of generalization, from the horizon of the view as it is.
ViewDistances settle_distances(const Scene& scene, const Deformation& deformation, const CameraParameters& camera, const LazyRegion& region,
                               std::vector<DerivedValue>& derived);

}  // namespace belvedere
