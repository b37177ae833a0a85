#pragma once

#include <string>

#include "base/run.h"
#include "renderer/scene/scene_file.h"
#include "renderer/style/fit_style.h"
#include "tools/pick/picking.h"

namespace belvedere::tools {

// What commands do with a painting, for the studio and for Python.

// Of `exemplar pick`: a painting and the terrain of a scene, for a page without a server of its
// own. Error as that command.
PickingInput picking_input(const LoadedScene& scene, const std::string& painting,
                           const std::string& pairs, const Run& run);
// `style fit` of a painting in memory: encoded sRGB, 0…1. `alpha`: empty or of its size; below 1 a
// pixel is not used. `mask`: as of fit_style; an empty one receives inferred classes. `name`: for
// messages. Error as segment_painting and fit_style.
Style fit_painting(const Grid<glm::vec3>& picture, const Grid<float>& alpha,
                   Grid<std::uint8_t>& mask, const std::string& name,
                   const StyleFitParameters& parameters, Progress& progress);
// As `style fit PAINTING --out OUT`.
void write_fitted_style(const std::string& painting, const std::string& out, Progress& progress);

}  // namespace belvedere::tools
