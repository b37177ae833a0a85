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
  // Of the ground of a usual panorama; a darker painting is lightened as by cleaning.
  double min_ground_lightness = 0.56;
};

// The look of a painting (encoded sRGB, 0…1) by its mask: ids of classes, 200 for far air, 255 for
// what is not used. `reference` is a palette whose light and dark are those of maps (summer): hue
// is the painter's, lightness the map's. Error(usage) where sizes differ, Error(input) for masks
// with other numbers or too little ground.
Style fit_style(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                const Palette& reference, const StyleFitParameters& parameters, Progress& progress);

}  // namespace belvedere
