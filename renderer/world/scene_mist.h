#pragma once

#include "renderer/mist/mist_sight.h"
#include "renderer/scene/scene.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/world/view.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// The mist that a scene asks for over its terrain; empty where it asks for none. Throws Error(usage) for places that cannot be.
MistAir make_scene_mist(const Scene& scene, const View& view, const TerrainModel& terrain, const Deformation& deformation,
                        const Camera& camera);

}  // namespace belvedere
