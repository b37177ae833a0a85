#pragma once

#include "renderer/base/progress.h"
#include "renderer/lit_picture.h"
#include "renderer/paint.h"
#include "renderer/scene.h"

namespace belvedere {

// Paints a sheet on a made-up terrain with the scene's palette and the light from the scene's side, so that every guide of it is exactly
// known. It carries no trees, no houses and no sky: those are painted on the target last.
PaintedExemplar paint_sheet(const SceneExemplar& wish, const Stage& target, Progress& progress);

}  // namespace belvedere
