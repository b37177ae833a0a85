#pragma once

#include <string>

#include "base/run.h"
#include "renderer/scene/scene_file.h"
#include "tools/pick/picking.h"

namespace belvedere::tools {

// What commands do with a painting, for the studio.

// Of `exemplar pick`: a painting and the terrain of a scene, for a page without a server of its
// own. Error as that command.
PickingInput picking_input(const LoadedScene& scene, const std::string& painting,
                           const std::string& pairs, const Run& run);
// As `style fit PAINTING --out OUT`.
void write_fitted_style(const std::string& painting, const std::string& out, Progress& progress);

}  // namespace belvedere::tools
