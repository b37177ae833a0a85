#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"
#include "base/progress.h"
#include "renderer/style/fit/class_ramps.h"
#include "renderer/style/fit/clean_mask.h"
#include "renderer/style/fit/fit_brushwork.h"
#include "renderer/style/fit/fit_sky.h"
#include "renderer/style/fit/separate_classes.h"
#include "renderer/style/style.h"

namespace belvedere {

struct StyleFitParameters {
  std::string name;
  std::string origin;  // painter, title, year and where the picture comes from
  std::string licence;
  CleanMaskParameters mask;
  ClassRampParameters ramps;
  SeparateParameters separate;
  BrushworkParameters brushwork;
  SkyParameters sky;
  // Of the ground of a typical panorama; darker paintings are lightened (A6).
  double min_ground_lightness = 0.56;
};

// Fits the style of a painting (encoded sRGB, 0…1). The mask holds class ids, 200 for distant haze
// and 255 for unused pixels. `reference` is a palette with the lightness of maps (summer): hues
// come from the painting, the order of lightness from the reference. Error(usage) where sizes
// differ, Error(input) for masks with other numbers or too little ground.
Style fit_style(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                const Palette& reference, const StyleFitParameters& parameters, Progress& progress);

}  // namespace belvedere
