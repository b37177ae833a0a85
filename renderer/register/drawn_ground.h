#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/io/dem.h"
#include "terrain/register/control_pairs.h"

namespace belvedere {

// The ground with valleys as wide as a painter drew them (terrain/generalize/widen_valleys.h), and
// where places of the map lie on it.
struct DrawnGround {
  double valleys_m = 0.0;
  Dem dem;                       // with the altitudes that are drawn
  Grid<glm::vec2> goes_to = {};  // as WidenedValleys; empty: nothing moved

  glm::dvec2 drawn_position(glm::dvec2 position) const;
  glm::dvec2 map_position(glm::dvec2 drawn) const;
  // At its drawn position, with the altitude there.
  ControlPair drawn(ControlPair pair) const;
  std::vector<ControlPair> drawn(std::span<const ControlPair> pairs) const;
};

// As a scene with generalize.widen_valleys_m draws it: lakes stay.
DrawnGround draw_ground(const Dem& dem, double valleys_m, Progress& progress);

}  // namespace belvedere
