#pragma once

#include "base/progress.h"
#include "renderer/scene/scene.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/guidance.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// Where handles fold the ground: Error(usage) naming the handle, the position and a remedy if that
// is in the picture, unless the scene allows it; a note otherwise.
void check_folds(const SceneDeform& scene, const TerrainModel& terrain,
                 const Deformation& deformation, const Camera& camera, Progress& progress);

}  // namespace belvedere
