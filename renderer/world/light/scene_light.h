#pragma once

#include <memory>

#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/light_field.h"
#include "renderer/world/view.h"
#include "terrain/io/dem.h"

namespace belvedere {

// The light of a scene's regions and clouds, on its terrain and under its sun; null where it has
// neither. Throws Error(usage) where the picture's sun is not above the horizon, and for errors in
// positions and files of areas; Error(input) for a required file that is missing. Notes optional
// files that are missing: their regions are left out.
std::shared_ptr<const LightField> make_light_field(const LoadedScene& loaded, const Dem& dem,
                                                   const View& view,
                                                   Progress& progress = silent_progress());

}  // namespace belvedere
