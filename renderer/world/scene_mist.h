#pragma once

#include "renderer/mist/mist_sight.h"
#include "renderer/scene/scene.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/world/view.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// The mist of a scene over its terrain; empty where it has none. Throws Error(usage) for invalid
// positions.
MistAir make_scene_mist(const Scene& scene, const View& view, const TerrainModel& terrain,
                        const Deformation& deformation, const Camera& camera);

}  // namespace belvedere
