#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/view_shape.h"
#include "renderer/trace/camera.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// A camera's own picture, in any projection.
class CameraPicture final : public PictureMap {
 public:
  explicit CameraPicture(const CameraParameters& parameters);
  glm::dvec2 position(glm::dvec2 direction, double depression) const override;

 private:
  std::unique_ptr<Camera> camera_;
  double azimuth_deg_;
};

// The directions that a camera looks in, (right, ahead), one per column.
std::vector<glm::dvec2> camera_directions(const CameraParameters& camera, int columns);

// From where level ground meets the lower edge of a picture to its horizon, where level ground is
// highest in it. Level ground is at the altitude that two fifths of the ground in view lie below,
// raised and bent as in the view.
struct ViewReach {
  double near_m = 0.0;
  double far_m = 0.0;  // 0: no data lie in the direction of the view
};
ViewReach find_reach(const CoarseGround& ground, const Deformation& deformation,
                     const CameraParameters& camera);

}  // namespace belvedere
