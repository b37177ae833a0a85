#pragma once

#include <memory>

#include "renderer/trace/camera.h"

namespace belvedere {

// The table's projection has distance 1. distance: from the axis of the cylinder back to the centre
// of projection, in radii of the cylinder. 0 is a perspective whose vertical lines stay vertical, 1
// the Pannini projection, stereographic horizontally.
std::unique_ptr<Camera> make_panini_camera(const CameraParameters& parameters, double distance);

}  // namespace belvedere
