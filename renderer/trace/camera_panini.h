#pragma once

#include <memory>

#include "renderer/trace/camera.h"

namespace belvedere {

// The projection of the table is that of distance 1. distance: how far behind the axis of the cylinder its picture is looked at from, in
// radii of the cylinder. 0 is a perspective whose upright lines stay upright, 1 the Pannini projection, stereographic across.
std::unique_ptr<Camera> make_panini_camera(const CameraParameters& parameters, double distance);

}  // namespace belvedere
