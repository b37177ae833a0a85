#pragma once

#include <glm/vec2.hpp>

#include "renderer/scene/scene.h"
#include "terrain/register/registration.h"

namespace belvedere {

// The scene whose picture shows every place where the painting shows it: its camera, deformation
// and output size, without the terrain's sources. What a registration leaves open is chosen as
// painters do: ground is level at the farthest pair of a cylinder (height of the eye, pitch and
// bend trade off exactly), and the eye is so high that the bend only lowers the ground. Beyond the
// pairs' distances the bend keeps its inclination and exaggeration its value.
Scene registered_scene(const Registration& registration, glm::ivec2 painting_px);

// A handle as scenes state it.
SceneHandle scene_handle(const DeformHandle& handle);

}  // namespace belvedere
