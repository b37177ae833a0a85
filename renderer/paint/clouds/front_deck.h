#pragma once

#include <array>
#include <cstdint>

#include "renderer/paint/clouds/clouds.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {

// The cloud deck of a front approaching from one side, seen from below: its lines start at the
// sky's vanishing point, its edge is ragged and bright. Caches lattice values: use one per thread.
class FrontDeck {
 public:
  FrontDeck(const SkyParameters& parameters, const SkyLook& look);
  struct Look {
    float cover = 0.0F;  // 0…1
    float light = 0.0F;  // 0 under the thick deck … 1 its bright edge
  };
  // At a position of the picture, px; empty near the horizon and below.
  Look at(double x_px, double y_px);

 private:
  const SkyParameters parameters_;
  const SkyLook look_;
  double side_;        // +1: the deck is right of its edge, -1 left
  double edge_slope_;  // of its edge: columns to the side per row above the vanishing point
  GroundNoise ragged_, torn_, folds_, fine_;
};

}  // namespace belvedere
