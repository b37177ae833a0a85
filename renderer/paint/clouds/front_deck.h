#pragma once

#include <array>
#include <cstdint>

#include "renderer/paint/clouds/clouds.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {

// The deck of cloud of a front that draws up from one side, seen from below: its lines come from the sky's vanishing point, its edge is
// ragged and bright. Remembers lattice values: one for each thread.
class FrontDeck {
 public:
  FrontDeck(const SkyParameters& parameters, const SkyLook& look);
  struct Look {
    float cover = 0.0F;  // 0…1
    float light = 0.0F;  // 0 under the thick deck … 1 its bright edge
  };
  // At a place of the picture, px; nothing near the horizon and below.
  Look at(double x_px, double y_px);

 private:
  const SkyParameters parameters_;
  const SkyLook look_;
  double side_;        // +1: the deck lies right of its edge, -1 left
  double edge_slope_;  // of its edge: columns to the side for a row of height over the vanishing point
  GroundNoise ragged_, torn_, folds_, fine_;
};

}  // namespace belvedere
