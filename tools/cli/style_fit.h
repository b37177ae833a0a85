#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"
#include "base/progress.h"
#include "renderer/style/fit_style.h"

namespace belvedere::tools {

// `style fit` of a painting in memory: encoded sRGB, 0…1. `alpha`: empty or of its size; below 1 a
// pixel is not used. `mask`: as of fit_style; an empty one receives the classes that `exemplar
// segment` infers. `name`: of the painting, for messages. Error as segment_painting and fit_style.
Style fit_painting(const Grid<glm::vec3>& picture, const Grid<float>& alpha,
                   Grid<std::uint8_t>& mask, const std::string& name,
                   const StyleFitParameters& parameters, Progress& progress);

}  // namespace belvedere::tools
