#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "renderer/style/fit/style_painting.h"
#include "renderer/style/style.h"

namespace belvedere {

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
