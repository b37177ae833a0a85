#include "renderer/register/registered_view.h"

namespace belvedere {

namespace {

View view_of_size(const Scene& scene, const Dem& dem, glm::ivec2 size_px, Progress& progress) {
  Scene sized = scene;
  sized.output.width = size_px.x;
  sized.output.height = size_px.y;
  return make_view(sized, dem, progress);
}

}  // namespace

RegisteredView::RegisteredView(const Registration& registration, const Scene& scene, const Dem& dem,
                               glm::ivec2 size_px, Progress& progress)
    : RegisteredView(registration, dem, view_of_size(scene, dem, size_px, progress)) {}

RegisteredView::RegisteredView(const Registration& registration, const Dem& dem, const View& view)
    : registration_(registration),
      dem_(dem),
      deformation_(view.deform, view.viewer_xy),
      surface_(
          deform(dem.altitude_m, dem.transform, glm::dvec3(view.viewer_xy, 0.0), deformation_)),
      camera_(make_camera(view.camera)),
      tracer_(surface_),
      map_(dem.altitude_m, nothing_moved_, dem.transform, deformation_, surface_, *camera_,
           tracer_) {}

}  // namespace belvedere
