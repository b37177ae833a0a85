#pragma once

#include "renderer/image/image_io.h"
#include "renderer/world/world.h"

namespace belvedere {

// The header of every file of a picture: provenance (scene, versions, hashes of the inputs),
// camera, coordinate system, sun.
FileNotes make_world_notes(const LoadedScene& loaded, const World& world);

}  // namespace belvedere
