#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/io/dem.h"
#include "terrain/register/control_pairs.h"
#include "terrain/register/registration.h"

namespace belvedere {

// The ground with valleys as wide as a painter drew them (terrain/generalize/widen_valleys.h), and
// where places of the map lie on it.
struct DrawnGround {
  double valleys_m = 0.0;
  Dem dem;                       // with the altitudes that are drawn
  Grid<glm::vec2> goes_to = {};  // as WidenedValleys; empty: nothing moved

  glm::dvec2 drawn_position(glm::dvec2 position) const;
  // At its drawn position, with the altitude there.
  ControlPair drawn(ControlPair pair) const;
  std::vector<ControlPair> drawn(std::span<const ControlPair> pairs) const;
};

// Draws the ground as a scene with generalize.widen_valleys_m does: lakes stay.
DrawnGround draw_ground(const Dem& dem, double valleys_m, Progress& progress);

struct PaintRegistration {
  Registration registration;
  int rounds = 0;           // that the pairs accepted, of three
  std::size_t matches = 0;  // places of the last of them that were found in the paint
  DrawnGround ground = {};  // on which the registration's places lie
};

// Improves a registration by the painting itself: three times, with smaller patches each time, the
// ground is traced as it is registered, its patches are found in the paint (match_paint), and the
// registration is fitted again with them (refine_registration). After the first round the ground
// may change to one with wider valleys, by 150, 300 or 450 m: that which the paint shows best
// (paint_evidence). A round that makes the pairs' own
// leave-one-out worse is left out, and so is one that needs a wider painting (400, 600 and 600 px).
PaintRegistration register_by_paint(const Registration& from_pairs,
                                    std::span<const ControlPair> pairs,
                                    const Grid<glm::vec3>& painting, const Dem& dem,
                                    Progress& progress);

}  // namespace belvedere
