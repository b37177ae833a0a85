#pragma once

#include "renderer/image/image_io.h"
#include "renderer/world/lit_picture.h"

namespace belvedere {

// What the header of every file of a picture says: provenance (scene, versions, hashes of the inputs), camera, coordinate system, sun.
FileNotes make_stage_notes(const LoadedScene& loaded, const Stage& stage);

}  // namespace belvedere
