#pragma once

#include "renderer/scene/scene.h"

namespace belvedere {

// A picture of the same shape, at least 16 px high. The width of the sheet is unchanged, so strokes
// keep their size on it.
SceneOutput with_width(SceneOutput output, int width_px);

// A quick preview of a scene: the same sheet at a third of its pixels per side (rounded, at least
// 64, never more than the scene asks for), with one sample per pixel, a quarter of the sky
// directions, and all paint as strokes: no texture is painted or copied.
Scene make_draft(Scene scene);

}  // namespace belvedere
