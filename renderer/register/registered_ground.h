#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "base/grid.h"
#include "base/progress.h"
#include "renderer/scene/scene.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/geo_map.h"
#include "renderer/trace/tracer.h"
#include "renderer/world/view.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/register/registration.h"

namespace belvedere {

// The terrain as a registration shows it, prepared for tracing: owns the deformed surface, its
// acceleration structure and the camera. Immutable; all calls are safe from any thread.
class RegisteredView {
 public:
  // scene: registered_scene() of the registration; dem, which must outlive the view: its terrain,
  // or a coarser one; size_px: of the picture, which may be smaller than the painting.
  RegisteredView(const Registration& registration, const Scene& scene, const Dem& dem,
                 glm::ivec2 size_px, Progress& progress);
  RegisteredView(const RegisteredView&) = delete;
  RegisteredView& operator=(const RegisteredView&) = delete;

  const Registration& registration() const { return registration_; }
  const Dem& dem() const { return dem_; }
  glm::ivec2 size_px() const { return camera_->size(); }
  const Camera& camera() const { return *camera_; }
  const Deformation& deformation() const { return deformation_; }
  // Between the ground and pixels of size_px().
  const GeoMap& map() const { return map_; }

 private:
  RegisteredView(const Registration& registration, const Dem& dem, const View& view);

  const Registration registration_;
  const Dem& dem_;
  const Deformation deformation_;
  const DeformedSurface surface_;
  const std::unique_ptr<const Camera> camera_;
  const Tracer tracer_;
  const Grid<glm::vec2> nothing_moved_ = {};
  const GeoMap map_;
};

// The ground that each pixel of a painting shows by its registration, at any size; NaN where it
// shows sky.
struct RegisteredGround {
  Grid<float> altitude_m;
  Grid<float> distance_m;  // from the eye
  Grid<float> sigma_px;    // how far the place may be off in one direction: standard deviation, in
                           // pixels of the painting, without that of the view; on a mountain that
                           // was moved, what its move leaves open too (MountainDeviation)
  std::size_t folded = 0;  // folded_facets() of the view, where that is asked for
  Grid<glm::dvec2> position = {};  // CRS
  Grid<glm::vec3> normal = {};     // of the exaggerated ground, where handles moved it
};

// Ratio of the distances of two neighbours from which they are a silhouette, not a slope.
inline constexpr float silhouette_jump = 1.06F;

// Traces all pixels of a view, without folded facets.
RegisteredGround trace_registered(const RegisteredView& view);
// Facets of the ground in the picture that the registration turns over.
std::size_t folded_facets(const RegisteredView& view);

// The largest of 20, 50, 100, 200, 500 m that gives some ten contours or more.
double contour_step_m(const Grid<float>& altitude_m);

// The painting with lines over it: contours of altitude in black, every fifth in white, the
// terrain's skyline in red, its other silhouettes in yellow. All of the same size.
Grid<glm::vec3> contours_over(const Grid<glm::vec3>& painting, const RegisteredGround& ground,
                              double step_m);

// From pale, trusted, to dark red at limit_px and beyond; sky is blue.
Grid<glm::vec3> trust_picture(const Grid<float>& sigma_px, double limit_px);

// The scene whose picture shows every place where the painting shows it: its camera, deformation
// and output size, without the terrain's sources. What a registration leaves open is chosen as
// painters do: ground is level at the farthest pair of a cylinder (height of the eye, pitch and
// bend trade off exactly), and the eye is so high that the bend only lowers the ground. Beyond the
// pairs' distances the bend keeps its inclination and exaggeration its value.
Scene registered_scene(const Registration& registration, glm::ivec2 painting_px);

// A handle as scenes state it.
SceneHandle scene_handle(const DeformHandle& handle);

}  // namespace belvedere
