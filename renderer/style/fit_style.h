#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "base/grid.h"
#include "base/progress.h"
#include "renderer/style/fit/class_ramps.h"
#include "renderer/style/fit/fit_brushwork.h"
#include "renderer/style/fit/fit_sky.h"
#include "renderer/style/fit/separate_classes.h"
#include "renderer/style/fit/style_painting.h"
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
  SkyFitParameters sky;
  // Minimum lightness of the ground of a typical panorama; darker paintings are lightened (A6).
  double min_ground_lightness = 0.56;
};

// Fits the style of a painting (encoded sRGB, 0…1). The mask holds class ids, 200 for distant haze
// and 255 for unused pixels. `reference` is a palette with the lightness of maps (summer): hues
// come from the painting, the order of lightness from the reference. Error(usage) where sizes
// differ, Error(input) for masks with other numbers or too little ground.
Style fit_style(const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                const Palette& reference, const StyleFitParameters& parameters, Progress& progress);

struct LightenedRamps {
  ClassRamps ramps{};
  double power = 1.0;  // of lightness: 1 where nothing was done
};

// Lightens the ramps of dark paintings, as if their varnish were cleaned (recipe A6): one power of
// lightness for all ramps, with max_lightness unchanged, until the ground of a typical panorama has
// the mean lightness `goal` (or the power is .45).
LightenedRamps lighten_ramps(const ClassRamps& ramps, double goal, double max_lightness,
                             const LightLaw& law);

// Colours of air and leaves of a painting (recipe A8); OKLab.
struct StyleAir {
  glm::dvec3 near{0.0};  // where haze begins
  glm::dvec3 far{0.0};
  glm::dvec3 mist{0.0};                // between ranges
  double haze = 1.0;                   // factor on the scene's haze, .7…1.25
  bool far_seen = false;               // the mask contains distant haze
  std::array<glm::dvec3, 4> leaves{};  // by hue
  glm::dvec3 larch{0.0};
};
// `horizon`: the colour of the sky's lowest row; none: a painting without sky.
StyleAir fit_air(const StylePainting& painting, const std::optional<glm::dvec3>& horizon);

}  // namespace belvedere
