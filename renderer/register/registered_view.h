#pragma once

#include <glm/vec2.hpp>
#include <memory>

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

}  // namespace belvedere
