#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "renderer/style/fit/clean_mask.h"

namespace belvedere {

// A painting as the steps of fitting read it.
struct StylePainting {
  Grid<glm::vec3> colours;              // OKLab
  Grid<glm::vec3> soft;                 // without what is finer than 0.8 px, inside each class
  Grid<std::uint8_t> drawn;             // the mask as given
  Grid<std::uint8_t> clean;             // clean_mask of it
  std::vector<LandCoverClass> classes;  // of the ground, that have texels enough
  std::vector<glm::vec3> every;         // colours of the whole painting, not too many of them
  std::vector<glm::vec3> ground;        // soft colours of all ground and far air, likewise
  double min_lightness = 0.0;           // that ramps may have: those of the painting, about
  double max_lightness = 1.0;
};

// `painting` is encoded sRGB. Error(usage) where sizes differ, Error(input) for numbers that are no
// classes, and where no class of the ground has texels enough.
StylePainting prepare_painting(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                               const CleanMaskParameters& parameters = {});

// Those of one class of the mask, at most about `most` of them: every n-th in the order of rows.
std::vector<glm::vec3> class_texels(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                                    LandCoverClass id, std::size_t most);
bool has_class(const StylePainting& painting, LandCoverClass id);

}  // namespace belvedere
