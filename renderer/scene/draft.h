#pragma once

#include "renderer/scene/scene.h"

namespace belvedere {

// A first look at a scene: the same sheet at a third of its pixels a side (rounded, at least 64, never more than the scene asks for), with
// one line of sight through each pixel, a quarter of the directions to the sky, and all paint as strokes: no texture is painted or copied.
Scene make_draft(Scene scene);

}  // namespace belvedere
