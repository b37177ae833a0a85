#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "renderer/style/fit/clean_mask.h"

namespace belvedere {

// A painting prepared for the steps of fitting.
struct StylePainting {
  Grid<glm::vec3> colours;              // OKLab
  Grid<glm::vec3> soft;                 // blurred with sigma 0.8 px within each class
  Grid<std::uint8_t> drawn;             // the mask as given
  Grid<std::uint8_t> clean;             // clean_mask of it
  std::vector<LandCoverClass> classes;  // of the ground, with enough texels
  std::vector<glm::vec3> every;         // a sample of the colours of the whole painting
  std::vector<glm::vec3> ground;        // a sample of the soft colours of ground and distant haze
  double min_lightness = 0.0;           // limits of ramps: about those of the painting
  double max_lightness = 1.0;
};

// `painting` is encoded sRGB. Error(usage) where sizes differ, Error(input) for numbers that are
// not classes, and where no class of the ground has enough texels.
StylePainting prepare_painting(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                               const CleanMaskParameters& parameters = {});

// Colours of one class of the mask, at most `most`: every n-th by rows.
std::vector<glm::vec3> class_texels(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                                    LandCoverClass id, std::size_t most);
bool has_class(const StylePainting& painting, LandCoverClass id);

}  // namespace belvedere
